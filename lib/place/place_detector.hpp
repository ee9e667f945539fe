#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "place/neighbourhood.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// One stay at a place, from the crossing of the arrival gateway to that of the departure gateway.
/// Frame `place`: the orientation of the lpm frame, its origin at the neighbourhood's centre, moved
/// to the nearest corner of a cell.
struct PlaceVisit {
  TimePoint entered;
  TimePoint left;
  Pose2 T_lpm_place;                 ///< A pure translation by whole cells.
  PlaceNeighbourhood neighbourhood;  ///< In frame place.
  int arrival_gateway = -1;          ///< -1: the robot started here.
  int departure_gateway = -1;        ///< -1: the robot is still here at the end of the input.
  Pose2 T_place_robot_at_entry;
  Pose2 T_place_robot_at_exit;
  OccupancyGrid lpm;  ///< In frame place; cut at the gateways' extent and a margin.
};

enum class PlaceEventKind {
  kEntered,           ///< The robot is within a neighbourhood, maybe not complete yet.
  kLeft,              ///< A visit is closed; carries it.
  kGatewayConfirmed,  ///< The place the robot is at has this gateway.
  kGatewayRetracted,  ///< What was confirmed before is no gateway.
};

struct PlaceEvent {
  PlaceEventKind kind = PlaceEventKind::kEntered;
  TimePoint time;
  Vector2d p_lpm_center = Vector2d::Zero();  ///< Of the neighbourhood it is about.
  std::optional<Gateway> gateway;            ///< In frame lpm; of gateway events.
  std::optional<PlaceVisit> visit;           ///< Of kLeft.
};

/// What the detector counted since it was made.
struct PlaceDetectorReport {
  std::int64_t looks = 0;               ///< Recomputations of the places around.
  std::int64_t visits = 0;              ///< Closed and emitted.
  std::int64_t turn_arounds = 0;        ///< Returns that took a visit up again.
  std::int64_t dropped_incomplete = 0;  ///< Visits dropped: the star was never complete.
  std::int64_t dropped_unlocated = 0;  ///< Visits dropped: no gateway on the robot's way in or out.
};

/// Tells, from the robot's way through its local map, when it is at a place and which place that
/// is.
///
/// A visit opens when the robot is inside a neighbourhood. The star that counts is the complete one
/// read most often during the stay. The visit is closed when the robot is beyond a gateway, and
/// emitted when it has reached another place (or at the end): until then the robot may turn around
/// and come back through the same gateway, which is no new experience but the same visit continued.
class PlaceDetector {
 public:
  /// @pre validate(options).ok()
  explicit PlaceDetector(const PlaceOptions& options);

  /// Takes a pose and the local map at that time. The lpm frame is continuous; the grid may scroll
  /// within it. Times must not decrease; an older pose is ignored.
  [[nodiscard]] std::vector<PlaceEvent> observe(TimePoint time,
                                                const Pose2& T_lpm_robot,
                                                const OccupancyGrid& grid);

  /// Ends the input: the visits that wait, the last one without a departure gateway when the robot
  /// is still there. At most two.
  [[nodiscard]] std::vector<PlaceVisit> finish();

  [[nodiscard]] const PlaceDetectorReport& report() const { return report_; }
  /// The places of the last look, in frame lpm.
  [[nodiscard]] const std::vector<PlaceNeighbourhood>& places_around() const { return around_; }

 private:
  PlaceOptions options_;
  PlaceDetectorReport report_;
  std::vector<PlaceNeighbourhood> around_;
};

}  // namespace cairn
