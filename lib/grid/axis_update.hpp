#pragma once

#include <cstdint>
#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/free_component.hpp"
#include "grid/medial_axis.hpp"
#include "grid/thinning.hpp"

namespace cairn {

/// Finds medial axes, one after the other, without asking for memory each time. Every result is
/// that of `medial_axis`.
class AxisUpdate {
 public:
  [[nodiscard]] MedialAxis axis(const DistanceTransform& distances,
                                Cell start,
                                const MedialAxisOptions& options);

 private:
  void fill_set();
  void mark_ridge(const DistanceTransform& distances, double min_angle_rad);
  void sort_by_clearance(const DistanceTransform& distances);

  FreeComponent component_;
  PaddedCells set_;
  PaddedCells ridge_;                  ///< Cells between basis points that lie far apart.
  std::vector<std::uint32_t> order_;   ///< Of the set, the least clearance first.
  std::vector<std::uint32_t> bucket_;  ///< By squared clearance: where in the order it begins.
};

}  // namespace cairn
