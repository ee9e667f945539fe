#pragma once

#include <cstddef>
#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/thinning.hpp"

namespace cairn {

/// Indices of the cells of a set, the least clearance first; of equals the lowest index.
/// Cost: linear in the cells, and in the largest squared clearance in cells.
/// @pre the set is as large as the transform's window
[[nodiscard]] std::vector<std::size_t> cells_by_clearance(const DistanceTransform& distances,
                                                          const CellMask& set);

}  // namespace cairn
