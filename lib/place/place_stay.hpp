#pragma once

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

struct StampedPose {
  TimePoint time;
  Pose2 T_lpm_robot;
};

/// One stay at a place while it lasts: what was read of it, and the robot's way.
class PlaceStay {
 public:
  /// @param way_before the last metres of the robot's way, oldest first
  /// @param has_come_from_outside false where the robot started here
  PlaceStay(const StampedPose& entry,
            std::vector<StampedPose> way_before,
            bool has_come_from_outside);

  /// The stay at a place that turned out to be one only when the robot had gone through it: a spot
  /// in a corridor where the robot took a doorway. None unless the way came in through one of its
  /// gateways and left through a doorway, after some time, and is beyond it by some distance.
  [[nodiscard]] static std::optional<PlaceStay> gone_through(const PlaceNeighbourhood& place,
                                                             const std::vector<StampedPose>& way,
                                                             TimePoint since,
                                                             const PlaceOptions& options);

  /// Takes the place as read once more.
  void add_reading(const PlaceNeighbourhood& reading);
  /// Takes the robot's next pose; poses closer than a few centimetres are not kept.
  void add_pose(const StampedPose& pose);

  /// Whether the star was read completely.
  [[nodiscard]] bool is_complete() const { return last_complete_.has_value(); }
  /// Whether it was read completely, twice in a row the same.
  [[nodiscard]] bool is_settled() const { return settled_.has_value(); }
  /// The reading that counts by now, in frame lpm: the last one that was complete and the same
  /// twice in a row; failing that the last complete one; the last one while none was complete.
  [[nodiscard]] const PlaceNeighbourhood& best() const;
  /// The last word: the place as read when the robot has left it, with all that was seen from it,
  /// if it is complete, or if the robot came and went through its gateways.
  /// @return whether the stay is one at a place at all
  bool conclude(const PlaceNeighbourhood& reading);
  [[nodiscard]] TimePoint entered() const { return entry_.time; }
  [[nodiscard]] TimePoint last_time() const { return way_.back().time; }

  /// Number of the gateway, of the best reading, that the robot crossed outward last and is beyond
  /// by some distance now; -1 while there is none.
  [[nodiscard]] int gateway_left_through(double beyond_m) const;
  /// Whether the robot is far outside without having crossed any gateway.
  [[nodiscard]] bool is_far_outside(double beyond_m) const;
  /// The gateway through which a way leads back inside: the last one crossed, if it was crossed
  /// inward; -1 otherwise.
  [[nodiscard]] int gateway_entered_by(const std::vector<StampedPose>& way) const;
  /// The gateway through which the stay was left; -1 while it lasts.
  [[nodiscard]] int departure() const { return departure_; }

  /// Keeps what of the map, by now, belongs to the place.
  void keep_map(const OccupancyGrid& grid, double crop_margin_m);
  /// Ends the stay: the robot is outside.
  void leave();
  /// Takes the stay up again that another one, at the same place, turned out to continue.
  void continue_with(const PlaceStay& later);

  [[nodiscard]] const std::vector<StampedPose>& way() const { return way_; }
  /// The last metres of the way.
  [[nodiscard]] std::vector<StampedPose> last_of_way(double keep_m) const;

  /// @pre conclude() or is_complete(), and the map was kept
  [[nodiscard]] PlaceVisit visit() const;

 private:
  [[nodiscard]] int arrival() const;
  /// Whether the way came in through one of these gateways and left through one.
  [[nodiscard]] bool is_crossed(const std::vector<Gateway>& gateways) const;
  [[nodiscard]] int nearest_gateway(const Vector2d& p_lpm) const;

  StampedPose entry_;
  bool has_come_from_outside_;
  std::vector<StampedPose> way_;
  PlaceNeighbourhood last_reading_;
  std::optional<PlaceNeighbourhood> last_complete_;
  std::optional<PlaceNeighbourhood> settled_;
  int departure_ = -1;
  Pose2 T_lpm_place_;
  OccupancyGrid crop_;
};

/// Whether two readings show the same gateways and the same star.
[[nodiscard]] bool agree(const PlaceNeighbourhood& a, const PlaceNeighbourhood& b);

}  // namespace cairn
