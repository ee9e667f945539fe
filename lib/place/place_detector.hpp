#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "place/place_stay.hpp"

namespace cairn {

enum class PlaceEventKind {
  kEntered,           ///< The robot is at a place whose star was seen completely.
  kLeft,              ///< A visit is closed and will not be taken up again; carries it.
  kGatewayConfirmed,  ///< The place the robot is at has this gateway.
  kGatewayRetracted,  ///< What was confirmed before is no gateway.
};

struct PlaceEvent {
  PlaceEventKind kind = PlaceEventKind::kEntered;
  TimePoint time;                            ///< Of kEntered and kLeft: of the passage itself.
  Vector2d p_lpm_center = Vector2d::Zero();  ///< Of the neighbourhood it is about.
  std::optional<Gateway> gateway;            ///< In frame lpm; of gateway events.
  std::optional<PlaceVisit> visit;           ///< Of kLeft.
};

/// What the detector counted since it was made.
struct PlaceDetectorReport {
  std::int64_t looks = 0;               ///< Recomputations of the places around.
  std::int64_t visits = 0;              ///< Closed and emitted.
  std::int64_t turn_arounds = 0;        ///< Returns that took a visit up again.
  std::int64_t dropped_incomplete = 0;  ///< Stays dropped: the star was never complete.
  std::int64_t retracted = 0;           ///< Stays dropped: seen as a whole, it is no place.
};

/// Tells, from the robot's way through its local map, when it is at a place and which place that
/// is.
///
/// A stay opens when the robot is inside a neighbourhood, and counts as entered once its star was
/// complete. The star that counts in the end is the complete one read most often during the stay.
/// The stay is closed when the robot is beyond a gateway. The visit is emitted when another place
/// is entered, right before that event, or at the end of the input: until then the robot may turn
/// around on the path and come back through the same gateway, which is no new experience but the
/// same visit continued.
class PlaceDetector {
 public:
  /// @pre validate(options).ok()
  explicit PlaceDetector(const PlaceOptions& options);

  /// Takes a pose and the local map at that time. The lpm frame is continuous; the grid may scroll
  /// within it. A pose older than the one before is ignored.
  [[nodiscard]] std::vector<PlaceEvent> observe(TimePoint time,
                                                const Pose2& T_lpm_robot,
                                                const OccupancyGrid& grid);

  /// Ends the input: the visit that waits, and the one that the robot is still at, without a
  /// departure gateway. At most two, in the order of time.
  [[nodiscard]] std::vector<PlaceVisit> finish();

  [[nodiscard]] const PlaceDetectorReport& report() const { return report_; }

  /// The places of the last look, in frame lpm.
  [[nodiscard]] const std::vector<PlaceNeighbourhood>& places_around() const { return around_; }

  /// How well the walls around told the robot's pose at the last look.
  [[nodiscard]] const IslandMeasure& island() const { return island_; }

  /// Whether the robot is at a place whose star was complete.
  [[nodiscard]] bool is_at_place() const { return stay_ && stay_->is_complete(); }

 private:
  void look(const StampedPose& now, const OccupancyGrid& grid, std::vector<PlaceEvent>* events);
  /// Takes up places that turned out to be such only behind the robot.
  void notice_late(const StampedPose& now,
                   const OccupancyGrid& grid,
                   std::vector<PlaceEvent>* events);
  void open_stay(const StampedPose& now, const PlaceNeighbourhood& reading);
  /// @param reading of the place the robot has left; nullptr: there is no place any more
  void close_stay(const StampedPose& now,
                  const OccupancyGrid& grid,
                  const PlaceNeighbourhood* reading,
                  std::vector<PlaceEvent>* events);
  /// Whether the stay is at the place that was left last, and the robot did not come around to it.
  [[nodiscard]] bool has_come_back() const;
  void take_up_again();
  [[nodiscard]] double same_spot_m(const PlaceNeighbourhood& place) const;
  void announce(const StampedPose& now, bool is_last_chance, std::vector<PlaceEvent>* events);
  void release_waiting(std::vector<PlaceEvent>* events);

  PlaceOptions options_;
  PlaceDetectorReport report_;
  LocalViewer viewer_;
  std::vector<PlaceNeighbourhood> around_;
  IslandMeasure island_;
  std::optional<StampedPose> last_pose_;
  std::optional<StampedPose> last_look_;
  std::vector<StampedPose> way_;  ///< The last metres before a stay.
  std::vector<Vector2d> driven_;  ///< Where the robot has gone of late, oldest first.
  std::optional<PlaceStay> stay_;
  std::optional<PlaceStay> waiting_;  ///< Left, but not yet followed by another place.
  std::vector<Gateway> confirmed_;    ///< Of the stay, in frame lpm.
  bool is_announced_ = false;
  TimePoint last_left_ = TimePoint::min();  ///< When the last stay ended.
};

}  // namespace cairn
