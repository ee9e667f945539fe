#pragma once

#include <memory>
#include <vector>

#include "refinement/trajectory_refiner.hpp"
#include "service/map_state.hpp"

namespace cairn {

/// Makes of a picture of the map one whose trajectory is refined, with places, segments and the
/// local map moved along, and whose travels are held against each other: what is published and
/// drawn. Off the thread that maps.
class MapRefiner {
 public:
  /// @pre validate(options).ok()
  explicit MapRefiner(const TrajectoryRefinementOptions& options = {}) : refiner_(options) {}

  /// The same for the same picture, whatever was refined before. The picture itself where there is
  /// nothing to refine, or the solve does not converge.
  [[nodiscard]] std::shared_ptr<const MapState> refined(
      const std::shared_ptr<const MapState>& state);

 private:
  TrajectoryRefiner refiner_;
};

/// At most one pose for each time, in the order in which the times first came. Where a burst of
/// readings bears one stamp, nothing tells which of them was taken then: the mean of their poses
/// errs least, that of the scans' own ones where there are any.
[[nodiscard]] std::vector<TimedPose> one_pose_for_each_time(const std::vector<TimedPose>& poses);

}  // namespace cairn
