#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "service/mapping_service.hpp"
#include "unit/lpm/simulated_laser.hpp"

namespace cairn::test {

/// What a robot's sensors say at one moment.
struct Readings {
  std::optional<OdometrySample> odometry;
  std::vector<LaserScan> scans;
};

/// A robot that drives through a mapping service on circles in a furnished room, ten readings a
/// second, and whatever is wrong with its readings.
class SimulatedDrive {
 public:
  using Disturbance = std::function<void(Readings*)>;

  explicit SimulatedDrive(std::vector<Wall> walls = furnished_room(), unsigned seed = 1)
      : walls_(std::move(walls)), laser_(walls_, seed) {}

  /// One laser in the middle that looks ahead, unless told otherwise.
  void mount_lasers(std::vector<Pose2> T_robot_lasers) {
    T_robot_lasers_ = std::move(T_robot_lasers);
  }
  SimulatedLaser& laser() { return laser_; }

  /// Goes on so many steps along the circle.
  void go(int steps, const Disturbance& disturbance = {}) {
    for (int i = 0; i < steps; ++i) {
      T_odom_robot_ = on_a_circle(++step_);
      T_world_robot_ = T_world_odom_ * T_odom_robot_;
      read(disturbance);
    }
  }
  /// Lifted up and set down elsewhere; the wheels do not notice.
  void be_carried_by(const Pose2& T_world_odom) { T_world_odom_ = T_world_odom; }
  /// Stays where it is.
  void stand(int steps, const Disturbance& disturbance = {}) {
    for (int i = 0; i < steps; ++i) {
      read(disturbance);
    }
  }
  void finish() { take(service_.finish()); }

  [[nodiscard]] const MappingService& service() const { return service_; }
  [[nodiscard]] const LocalisationHealth& health() const { return service_.health(); }
  /// All reasons that were told, whenever they changed.
  [[nodiscard]] const std::set<std::string>& reasons() const { return reasons_; }
  [[nodiscard]] const std::vector<PerceivedScan>& perceived() const { return perceived_; }
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }
  [[nodiscard]] const std::vector<Relocalisation>& relocalised() const { return relocalised_; }
  [[nodiscard]] const Pose2& T_world_robot() const { return T_world_robot_; }

  /// Where the robot truly is, in the lpm frame.
  [[nodiscard]] Pose2 T_lpm_robot() const { return on_a_circle(0).inverse() * T_world_robot_; }
  /// How far off the last pose is, in metres.
  [[nodiscard]] double error_m() const {
    return (perceived_.back().fix.T_lpm_robot.translation() - T_lpm_robot().translation()).norm();
  }
  /// Share of the occupied cells of the local map that are nowhere near a wall. What the map has
  /// differs from the world by a pose, or is mirrored at the x axis of the lpm frame.
  [[nodiscard]] double share_of_stray_walls(const Pose2& T_truth_lpm = {},
                                            bool is_mirrored = false) const {
    const OccupancyGrid& map = service_.local_map();
    const Pose2 T_world_lpm = on_a_circle(0) * T_truth_lpm;
    int occupied = 0;
    int stray = 0;
    for (int y = 0; y < map.geometry().height; ++y) {
      for (int x = 0; x < map.geometry().width; ++x) {
        if (map.state({x, y}) == CellState::kOccupied) {
          Vector2d p = map.geometry().center_of({x, y});
          p.y() *= is_mirrored ? -1.0 : 1.0;
          ++occupied;
          stray += distance_to_walls_m(T_world_lpm * p) > 0.3 ? 1 : 0;
        }
      }
    }
    return occupied > 100 ? static_cast<double>(stray) / occupied : 1.0;
  }

  static Pose2 on_a_circle(int step) {
    const double angle = 0.05 * step;
    return {1.5 * std::cos(angle), 1.5 * std::sin(angle), wrap_angle(angle + kPi / 2.0)};
  }

 private:
  void read(const Disturbance& disturbance) {
    time_s_ += 0.1;
    Readings readings;
    readings.odometry = OdometrySample{stamp(), T_odom_robot_};
    for (std::size_t i = 0; i < T_robot_lasers_.size(); ++i) {
      readings.scans.push_back(laser_.scan(T_world_robot_ * T_robot_lasers_[i], time_s_));
      readings.scans.back().T_robot_laser = T_robot_lasers_[i];
      readings.scans.back().laser = static_cast<int>(i);
    }
    if (disturbance) {
      disturbance(&readings);
    }
    if (readings.odometry) {
      take(service_.absorb(*readings.odometry));
    }
    for (LaserScan& scan : readings.scans) {
      ASSERT_TRUE(validate(scan).ok());
      take(service_.absorb(std::move(scan)));
    }
  }

  void take(Updates updates) {
    for (PerceivedScan& scan : updates.scans) {
      perceived_.push_back(std::move(scan));
    }
    for (Visit& visit : updates.visits) {
      visits_.push_back(std::move(visit));
    }
    if (updates.relocalised) {
      relocalised_.push_back(*updates.relocalised);
    }
    if (updates.is_health_changed) {
      reasons_.insert(std::string(to_string(health().state)) + ": " +
                      reason_of(health(), LocalisationOptions()));
    }
  }

  [[nodiscard]] TimePoint stamp() const {
    return time_of_utime(static_cast<std::int64_t>(std::llround(time_s_ * 1e6)));
  }

  [[nodiscard]] double distance_to_walls_m(const Vector2d& p) const {
    double nearest_m = 1e9;
    for (const Wall& wall : walls_) {
      const Vector2d along = wall.to - wall.from;
      const double share = std::clamp((p - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest_m = std::min(nearest_m, (wall.from + share * along - p).norm());
    }
    return nearest_m;
  }

  std::vector<Wall> walls_;
  SimulatedLaser laser_;
  std::vector<Pose2> T_robot_lasers_ = {Pose2()};
  MappingService service_{ServiceOptions()};
  int step_ = 0;
  double time_s_ = 0.0;
  Pose2 T_world_odom_;
  Pose2 T_odom_robot_ = on_a_circle(0);
  Pose2 T_world_robot_ = on_a_circle(0);
  std::set<std::string> reasons_;
  std::vector<PerceivedScan> perceived_;
  std::vector<Visit> visits_;
  std::vector<Relocalisation> relocalised_;
};

}  // namespace cairn::test
