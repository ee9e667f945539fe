#pragma once

#include <cstdint>
#include <vector>

#include "grid/distance_transform.hpp"
#include "region/region_options.hpp"

namespace cairn {

/// The free cells of a transform's window, each with the basin it lies in.
struct ClearanceBasins {
  static constexpr std::int32_t kNone = -1;  ///< Not free.

  int width = 0;
  int height = 0;
  std::vector<std::int32_t> basin_of;  ///< Row by row; numbered from 0 without gaps.
  std::int32_t count = 0;
};

/// Splits free space at its critical points. A critical point is a saddle of the clearance: a point
/// of the Voronoi diagram where clearance is locally minimal, between two larger maxima. Cells are
/// flooded from the largest clearance down; where two basins meet, they become one unless the
/// saddle is as narrow as a line between regions: at most `max_line_m` wide, and with a clearance
/// of at most `max_narrowing` times that of the lower maximum.
///
/// Source: Thrun and Bücken, AAAI 1996, "Topological Maps", steps 2 to 4; the flooding is the
/// watershed of Vincent and Soille, PAMI 13(6), 1991, run on the clearance.
/// Cost: linear in the cells.
[[nodiscard]] ClearanceBasins clearance_basins(const DistanceTransform& distances,
                                               const RegionOptions& options);

}  // namespace cairn
