#include "transport/frame_change.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cairn {
namespace {

/// How far something has moved from one map to the next.
struct Move {
  double distance_m = 0.0;
  double turn_rad = 0.0;
  /// More than what a map is drawn to.
  [[nodiscard]] bool is_noticed() const { return distance_m > 0.02 || turn_rad > 0.005; }
};
Move move_between(const Pose2& older, const Pose2& newer) {
  return {(newer.translation() - older.translation()).norm(),
          std::abs(turn_between(older.theta(), newer.theta()))};
}

}  // namespace

std::optional<cairn_lcm::frame_change_t> to_frame_change(const MapState& older,
                                                         const MapState& newer,
                                                         const Sender& sender) {
  const auto put_change = [](const Pose2& T_newer_older, double* x_m, double* y_m, double* rad) {
    *x_m = T_newer_older.x();
    *y_m = T_newer_older.y();
    *rad = wrap_angle(T_newer_older.theta());
  };
  if (older.trajectory.empty() || newer.trajectory.empty()) {
    return std::nullopt;
  }
  cairn_lcm::frame_change_t message{};
  message.utime = utime_of(newer.time);
  message.boot_id = sender.boot_id;
  message.map_id = sender.map_id;
  message.older_revision = older.topology_revision;
  message.newer_revision = newer.topology_revision;
  const Pose2 T_newer_older = newer.T_global_lpm * older.T_global_lpm.inverse();
  put_change(T_newer_older, &message.robot_dx_m, &message.robot_dy_m, &message.robot_dtheta_rad);
  const Pose2& T_older_robot = older.trajectory.back().T_global_robot;
  const Move robot = move_between(T_older_robot, T_newer_older * T_older_robot);
  message.largest_move_m = robot.distance_m;
  bool has_moved = robot.is_noticed();
  std::map<std::size_t, const MappedPlace*> older_places;  // by what they were first seen with
  for (const MappedPlace& place : older.places) {
    older_places[place.anchor_scan] = &place;
  }
  for (const MappedPlace& place : newer.places) {
    const auto before = older_places.find(place.anchor_scan);
    if (before == older_places.end()) {
      continue;
    }
    const Pose2& T_older_place = before->second->T_global_place.mean;
    const Move move = move_between(T_older_place, place.T_global_place.mean);
    if (move.is_noticed()) {
      has_moved = true;
      message.largest_move_m = std::max(message.largest_move_m, move.distance_m);
      message.place_id.push_back(place.id);
      put_change(place.T_global_place.mean * T_older_place.inverse(), &message.dx_m.emplace_back(),
                 &message.dy_m.emplace_back(), &message.dtheta_rad.emplace_back());
    }
  }
  message.num_places = static_cast<std::int32_t>(message.place_id.size());
  return has_moved ? std::optional(message) : std::nullopt;
}

}  // namespace cairn
