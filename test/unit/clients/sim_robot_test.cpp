#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>

#include "clients/sim/driver.hpp"
#include "clients/sim/laser.hpp"
#include "clients/sim/odometer.hpp"
#include "clients/sim/random_source.hpp"

namespace cairn::sim {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kLongest_steps = 100'000;

/// Distance from the point to the nearest leg of the path.
double off_path_m(const std::vector<Point>& path, Point point) {
  double nearest_m = distance_m(path.front(), point);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point& a = path[i - 1];
    const Point& b = path[i];
    const double length_m = distance_m(a, b);
    const double share =
        ((point.x_m - a.x_m) * (b.x_m - a.x_m) + (point.y_m - a.y_m) * (b.y_m - a.y_m)) /
        (length_m * length_m);
    const double on = std::min(1.0, std::max(0.0, share));
    nearest_m = std::min(
        nearest_m, distance_m({a.x_m + on * (b.x_m - a.x_m), a.y_m + on * (b.y_m - a.y_m)}, point));
  }
  return nearest_m;
}

struct Drive {
  double worst_off_path_m = 0.0;
  double fastest_m_per_s = 0.0;
  double fastest_turn_rad_per_s = 0.0;
  Pose end;
  bool has_arrived = false;
};

Drive driven(const std::vector<Point>& path, const Pose& start) {
  Driver driver(path, start, {});
  Drive drive;
  for (int step = 0; step < kLongest_steps && !driver.has_arrived(); ++step) {
    const Motion motion = driver.advance(kStep_s);
    drive.worst_off_path_m = std::max(drive.worst_off_path_m, off_path_m(path, driver.pose().at));
    drive.fastest_m_per_s = std::max(drive.fastest_m_per_s, motion.distance_m / kStep_s);
    drive.fastest_turn_rad_per_s =
        std::max(drive.fastest_turn_rad_per_s, std::abs(motion.turn_rad) / kStep_s);
  }
  drive.end = driver.pose();
  drive.has_arrived = driver.has_arrived();
  return drive;
}

TEST(Driver, FollowsCornersBothWaysWithinAQuarterOfAMetre) {
  const std::vector<Point> path = {{0, 0}, {10, 0}, {10, 8}, {20, 8}, {20, 0}};
  const Drive drive = driven(path, {path.front(), 0.0});
  EXPECT_TRUE(drive.has_arrived);
  EXPECT_LT(drive.worst_off_path_m, 0.25);
  EXPECT_LT(distance_m(drive.end.at, path.back()), 0.06);
}

TEST(Driver, TurnsOnTheSpotAtADeadEnd) {
  const std::vector<Point> path = {{0, 0}, {6, 0}, {0, 0}};
  const Drive drive = driven(path, {path.front(), 0.0});
  EXPECT_TRUE(drive.has_arrived);
  EXPECT_LT(drive.worst_off_path_m, 0.1);
  EXPECT_NEAR(std::abs(drive.end.theta_rad), std::numbers::pi, 0.2);
}

TEST(Driver, KeepsItsSpeeds) {
  const std::vector<Point> path = {{0, 0}, {10, 0}, {10, 8}, {0, 0}, {4, 0}};
  const Drive drive = driven(path, {path.front(), 3.0});
  EXPECT_TRUE(drive.has_arrived);
  EXPECT_LE(drive.fastest_m_per_s, DriverOptions{}.speed_m_per_s + 1e-9);
  EXPECT_LE(drive.fastest_turn_rad_per_s, DriverOptions{}.turn_speed_rad_per_s + 1e-9);
}

TEST(Driver, ArrivesOnEveryPathHoweverItZigzags) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    RandomSource random(seed, 0);
    std::vector<Point> path = {{0, 0}};
    for (int leg = 0; leg < 12; ++leg) {
      const double length_m = 0.05 + 3.0 * random.uniform();
      const double direction_rad = 2.0 * std::numbers::pi * random.uniform();
      path.push_back({path.back().x_m + length_m * std::cos(direction_rad),
                      path.back().y_m + length_m * std::sin(direction_rad)});
    }
    const Drive drive = driven(path, {path.front(), 6.0 * random.uniform()});
    EXPECT_TRUE(drive.has_arrived);
    EXPECT_LT(drive.worst_off_path_m, 0.4);
  }
}

TEST(Driver, ArrivesAtOnceWhereThePathIsAPoint) {
  EXPECT_TRUE(driven({{1, 2}}, {{1, 2}, 0.0}).has_arrived);
}

TEST(Odometer, WithoutErrorsIsTheTruth) {
  Odometer odometer({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 1);
  Pose truth;
  for (int step = 0; step < 1000; ++step) {
    const Motion motion = {0.006, 0.003 * std::sin(0.01 * step)};
    odometer.add(motion);
    truth = moved(truth, motion);
  }
  EXPECT_EQ(odometer.pose(), truth);
}

TEST(Odometer, StandsStillWithTheRobot) {
  Odometer odometer({}, 1);
  odometer.add({});
  EXPECT_EQ(odometer.pose(), Pose{});
}

TEST(Odometer, DriftsByItsBiasOnTheAverageOfSeeds) {
  double sum_rad = 0.0;
  double sum_m = 0.0;
  constexpr int kSeeds = 100;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    OdometerOptions options;
    Odometer odometer(options, seed);
    for (int step = 0; step < 1000; ++step) {
      odometer.add({0.01, 0.0});  // 10 m straight ahead.
    }
    sum_rad += odometer.pose().theta_rad;
    sum_m += odometer.pose().at.x_m;
  }
  EXPECT_NEAR(sum_rad / kSeeds, 0.04, 0.015);
  EXPECT_NEAR(sum_m / kSeeds, 10.2, 0.05);
}

TEST(Laser, SpansItsFieldOfViewFromRightToLeft) {
  const Laser laser({.beams = 271, .fov_deg = 270.0}, 1);
  EXPECT_NEAR(laser.first_bearing_rad(), -0.75 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(laser.first_bearing_rad() + 270 * laser.bearing_step_rad(), 0.75 * std::numbers::pi,
              1e-12);
}

TEST(Laser, AFullTurnHasNoBeamTwice) {
  const Laser laser({.beams = 360, .fov_deg = 360.0}, 1);
  EXPECT_NEAR(laser.bearing_step_rad(), std::numbers::pi / 180.0, 1e-12);
}

TEST(Laser, SaysInfinityWhereNothingReturns) {
  FloorPlan hall(200, 200, 0.25);
  for (int row = 1; row < 199; ++row) {
    for (int column = 1; column < 199; ++column) {
      hall.set_free({column, row});
    }
  }
  Laser laser({}, 1);
  for (const float range_m : laser.sweep(hall, {{25.0, 25.0}, 0.0})) {
    EXPECT_TRUE(std::isinf(range_m));
  }
}

TEST(Laser, HasItsNoiseAndItsShareOfDropouts) {
  FloorPlan room(22, 22, 0.25);
  for (int row = 1; row < 21; ++row) {
    for (int column = 1; column < 21; ++column) {
      room.set_free({column, row});
    }
  }
  const LaserOptions options;
  Laser laser(options, 1);
  const Pose pose = {{2.0, 3.0}, 0.4};
  int dropouts = 0;
  int returns = 0;
  double squares_m2 = 0.0;
  for (int sweep = 0; sweep < 100; ++sweep) {
    const std::vector<float> ranges_m = laser.sweep(room, pose);
    for (std::size_t beam = 0; beam < ranges_m.size(); ++beam) {
      const double bearing_rad = pose.theta_rad + laser.first_bearing_rad() +
                                 static_cast<double>(beam) * laser.bearing_step_rad();
      const double true_m = cast_ray_m(room, pose.at, bearing_rad, options.max_range_m);
      if (std::isinf(ranges_m[beam])) {
        ++dropouts;
      } else {
        ++returns;
        squares_m2 += std::pow(static_cast<double>(ranges_m[beam]) - true_m, 2);
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(dropouts) / (dropouts + returns), 0.005, 0.002);
  EXPECT_NEAR(std::sqrt(squares_m2 / returns), 0.01, 0.001);
}

}  // namespace
}  // namespace cairn::sim
