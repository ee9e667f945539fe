#pragma once

#include <array>
#include <vector>

#include "grid/distance_transform.hpp"
#include "region/region_options.hpp"

namespace cairn {

/// A gap in a wall, from end to end.
struct Doorway {
  std::array<Cell, 2> basis_points;  ///< The wall's ends, not free themselves.
  double length_cells = 0.0;         ///< From one to the other.
};

/// The cells of a doorway, its ends included; each lies beside the one before.
[[nodiscard]] std::vector<Cell> cells_of(const Doorway& doorway);

/// The doorways of a map, the narrowest first. A doorway is a line between two basis points that
/// see each other across the Voronoi diagram; it is at most `max_line_m` wide and so shallow that
/// free space is wider by the share `widening` within `doorway_depth_m` on either side, and
/// clearance falls on neither, while all other doorways are shut. Of lines that cross, or lie in
/// one doorway, the shortest stays.
///
/// Critical points (Thrun and Bücken, AAAI 1996) where the free space on one side of a door is no
/// larger than the door, as in a corridor, a cubicle or a closet, are hardly minima of clearance:
/// the shape of the walls shows them.
/// Cost: linear in the cells, and in the reach of a line for every cell of the Voronoi diagram.
[[nodiscard]] std::vector<Doorway> doorways(const DistanceTransform& distances,
                                            const RegionOptions& options);

}  // namespace cairn
