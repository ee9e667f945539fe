#pragma once

#include <string>
#include <vector>

#include "geometry/angle.hpp"
#include "place/place_detector.hpp"
#include "support/drawn_world.hpp"

namespace cairn::test {

/// A robot with a perfect laser and perfect poses that drives straight from mark to mark of a drawn
/// world, and tells the places it passes.
class Drive {
 public:
  Drive(const DrawnWorld& world, double field_rad, const PlaceOptions& options = {})
      : world_(world), field_rad_(field_rad), map_(world.empty_map()), detector_(options) {}

  /// Drives along the marks; turns on the spot at each.
  void along(const std::string& marks) {
    for (const char mark : marks) {
      const Vector2d target = world_.position_of(mark);
      if (is_placed_) {
        go_to(target);
      }
      at_ = target;
      is_placed_ = true;
    }
  }

  void finish() {
    for (PlaceVisit& visit : detector_.finish()) {
      visits_.push_back(std::move(visit));
    }
  }

  [[nodiscard]] const std::vector<PlaceVisit>& visits() const { return visits_; }
  [[nodiscard]] const std::vector<PlaceEvent>& events() const { return events_; }
  [[nodiscard]] const PlaceDetectorReport& report() const { return detector_.report(); }

 private:
  void go_to(const Vector2d& target) {
    constexpr double kStep_m = 0.1;
    constexpr int kTurnSteps = 8;
    const Vector2d way = target - at_;
    const double heading = std::atan2(way.y(), way.x());
    const double turn = turn_between(heading_rad_, heading);
    for (int i = 1; i <= kTurnSteps; ++i) {
      stand(Pose2(at_, heading_rad_ + turn * i / kTurnSteps));
    }
    heading_rad_ = heading;
    for (double s = kStep_m; s < way.norm(); s += kStep_m) {
      stand(Pose2(at_ + s * way.normalized(), heading));
    }
  }

  void stand(const Pose2& T_world_robot) {
    world_.look(T_world_robot, field_rad_, &map_);
    time_ += std::chrono::milliseconds(100);
    for (PlaceEvent& event : detector_.observe(time_, T_world_robot, map_)) {
      if (event.visit) {
        visits_.push_back(*event.visit);
      }
      events_.push_back(std::move(event));
    }
  }

  const DrawnWorld& world_;
  double field_rad_;
  OccupancyGrid map_;
  PlaceDetector detector_;
  bool is_placed_ = false;
  Vector2d at_ = Vector2d::Zero();
  double heading_rad_ = 0.0;
  TimePoint time_{};
  std::vector<PlaceVisit> visits_;
  std::vector<PlaceEvent> events_;
};

}  // namespace cairn::test
