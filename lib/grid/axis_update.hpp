#pragma once

#include <cstdint>
#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/free_component.hpp"
#include "grid/medial_axis.hpp"
#include "grid/thinning_update.hpp"

namespace cairn {

/// Finds the medial axis of a map, and follows it from one state of the map to the next: only
/// where clearance, basis points or the robot's piece of free space have changed the axis is worked
/// out again. The result is that of `medial_axis`.
class AxisUpdate {
 public:
  /// The axis of the first state, or of one that has nothing to do with the one before.
  [[nodiscard]] MedialAxis first(const DistanceTransform& distances,
                                 Cell start,
                                 const MedialAxisOptions& options);

  /// The axis of the next state.
  /// @param changed indices in the window of cells whose clearance or basis point has changed
  /// @param moved by how many cells the window has moved over the ground since
  [[nodiscard]] MedialAxis next(const DistanceTransform& distances,
                                const std::vector<std::uint32_t>& changed,
                                Cell moved,
                                Cell start,
                                const MedialAxisOptions& options);

 private:
  void find_component(const DistanceTransform& distances, Cell start);
  void note_changes(const std::vector<std::uint32_t>& changed, bool has_moved, std::uint32_t width);
  void note_border();
  void begin(const DistanceTransform& distances);
  void follow(const DistanceTransform& distances);
  void note_members();
  [[nodiscard]] bool is_ridge(const DistanceTransform& distances,
                              std::size_t at,
                              std::size_t padded) const;
  void sort_by_clearance(const PaddedCells& set);
  [[nodiscard]] MedialAxis traced(const DistanceTransform& distances);

  MedialAxisOptions options_;
  double max_cosine_ = 0.0;
  FreeComponent component_;
  PaddedCells members_;  ///< Of the component.
  std::size_t member_count_ = 0;
  ThinningUpdate thinning_;
  std::vector<std::uint8_t> noted_;    ///< By cell, 1: has changed. All 0 between two states.
  std::vector<std::uint32_t> seeds_;   ///< Of what has changed.
  std::vector<std::uint32_t> cells_;   ///< Of a set, ascending.
  std::vector<std::uint32_t> order_;   ///< Of the set, the least clearance first.
  std::vector<std::uint32_t> bucket_;  ///< By squared clearance: where in the order it begins.
  PaddedCells skeleton_;
};

}  // namespace cairn
