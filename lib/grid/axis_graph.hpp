#pragma once

#include <cstdint>
#include <vector>

#include "grid/medial_axis.hpp"
#include "grid/thinning.hpp"

namespace cairn {

/// Reads a thinned set of cells of the transform's window as a graph. `cells` are all of the
/// skeleton, in any order. Cells with other than two
/// neighbours become nodes, neighbouring ones where edges meet become one; a closed line gets a
/// node at its lowest cell.
[[nodiscard]] MedialAxis traced_axis(const PaddedCells& skeleton,
                                     std::vector<std::uint32_t> cells,
                                     const DistanceTransform& distances);

/// Takes away blind branches that reach less than the coastal distance beyond the clearance disc of
/// the node they leave from, the least deep first, and joins the two edges of nodes where only two
/// are left. Branches that lead to the border of the window stay.
[[nodiscard]] MedialAxis pruned(MedialAxis axis,
                                double coastal_distance_m,
                                const DistanceTransform& distances);

/// From one cell of an edge to the next.
[[nodiscard]] double step_cells(Cell a, Cell b);

/// Length of the part of an edge between two positions, in metres.
[[nodiscard]] double length_m(const AxisEdge& edge,
                              std::size_t from,
                              std::size_t to,
                              double cell_m);

}  // namespace cairn
