#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geometry/angle.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn::test {

struct Wall {
  Vector2d from;
  Vector2d to;
};

/// The four walls of a rectangle.
inline void add_box(const Vector2d& low, const Vector2d& high, std::vector<Wall>* walls) {
  const Vector2d right_low(high.x(), low.y());
  const Vector2d left_high(low.x(), high.y());
  walls->push_back({low, right_low});
  walls->push_back({right_low, high});
  walls->push_back({high, left_high});
  walls->push_back({left_high, low});
}

/// A room of 10 m x 8 m with a few things in it, without symmetry.
inline std::vector<Wall> furnished_room() {
  std::vector<Wall> walls;
  add_box({-5.0, -4.0}, {5.0, 4.0}, &walls);
  add_box({2.0, 1.0}, {3.0, 2.5}, &walls);
  add_box({-4.0, -3.0}, {-2.5, -2.0}, &walls);
  walls.push_back({{-5.0, 2.0}, {-3.0, 4.0}});
  return walls;
}

/// A straight corridor 2 m wide and so long that no end is in sight.
inline std::vector<Wall> endless_corridor() {
  return {{{-500.0, 1.0}, {500.0, 1.0}}, {{-500.0, -1.0}, {500.0, -1.0}}};
}

/// Distance along a beam to the nearest wall; infinity where there is none.
inline double range_to(const std::vector<Wall>& walls, const Vector2d& from, double bearing_rad) {
  const Vector2d way(std::cos(bearing_rad), std::sin(bearing_rad));
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    const Vector2d along = wall.to - wall.from;
    const Vector2d start = wall.from - from;
    const double cross = way.x() * along.y() - way.y() * along.x();
    if (std::abs(cross) < 1e-12) {
      continue;
    }
    const double range_m = (start.x() * along.y() - start.y() * along.x()) / cross;
    const double share = (start.x() * way.y() - start.y() * way.x()) / cross;
    if (range_m > 0.0 && share >= 0.0 && share <= 1.0) {
      nearest_m = std::min(nearest_m, range_m);
    }
  }
  return nearest_m;
}

/// A laser with 1 cm of noise in the middle of the robot, of 181 beams over 180 degrees unless said
/// otherwise.
class SimulatedLaser {
 public:
  explicit SimulatedLaser(std::vector<Wall> walls, unsigned seed = 1)
      : walls_(std::move(walls)), random_(seed) {}

  void set_beams(int beams, double span_rad) {
    beams_ = beams;
    span_rad_ = span_rad;
  }

  LaserScan scan(const Pose2& T_world_robot, double seconds) {
    constexpr double kMaxRange_m = 20.0;
    std::normal_distribution<double> noise(0.0, 0.01);
    LaserScan scan;
    scan.time = time_of_utime(static_cast<std::int64_t>(std::llround(seconds * 1e6)));
    scan.max_range_m = kMaxRange_m;
    for (int i = 0; i < beams_; ++i) {
      const double bearing_rad = span_rad_ * (static_cast<double>(i) / (beams_ - 1) - 0.5);
      const double range_m =
          range_to(walls_, T_world_robot.translation(), T_world_robot.theta() + bearing_rad) +
          noise(random_);
      scan.bearings_rad.push_back(static_cast<float>(bearing_rad));
      scan.ranges_m.push_back(range_m <= kMaxRange_m ? static_cast<float>(std::max(range_m, 0.01))
                                                     : std::numeric_limits<float>::infinity());
    }
    return scan;
  }

 private:
  std::vector<Wall> walls_;
  std::mt19937 random_;
  int beams_ = 181;
  double span_rad_ = kPi;
};

}  // namespace cairn::test
