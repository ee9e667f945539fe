#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "region/region_options.hpp"

namespace cairn {

/// Parts two regions. It joins a critical point with its two basis points.
struct CriticalLine {
  std::size_t from = 0;  ///< Regions, from < to.
  std::size_t to = 0;
  Cell critical_point;                 ///< Where clearance is largest along the line.
  std::array<Cell, 2> basis_points{};  ///< Nearest cells that are not free, on either side.
  double width_m = 0.0;                ///< Free space between the basis points.
};

/// A connected part of free space between critical lines: a room, a corridor, a hall.
struct Region {
  Cell centre;                     ///< The cell with the largest clearance.
  double clearance_m = 0.0;        ///< There; infinity where nothing bounds the region.
  double area_m2 = 0.0;            ///< With the furniture that stands free in it.
  std::vector<std::size_t> lines;  ///< Ascending.
};

/// The regions of a map and the critical lines that part them: GRID's topological graph.
struct RegionGraph {
  static constexpr std::int32_t kNoRegion = -1;

  GridGeometry geometry;
  std::vector<std::int32_t> region_of;  ///< For every cell of the grid, row by row.
  std::vector<Region> regions;          ///< In the order of their lowest cell.
  std::vector<CriticalLine> lines;      ///< Ordered by from, to, critical point.

  /// The region a cell lies in; kNoRegion where it is not free, or outside of the grid.
  [[nodiscard]] std::int32_t region_at(Cell c) const {
    return geometry.contains(c) ? region_of[geometry.index_of(c)] : kNoRegion;
  }
};

/// Regions of a whole map. Furniture is looked through; clearance basins give the regions; one that
/// is too small joins the neighbour across its widest line, or is dropped where it has none.
///
/// Source: Thrun and Bücken, AAAI 1996, "Topological Maps"; areas and a join of small regions as in
/// the Voronoi segmentation of Bormann et al., ICRA 2016.
/// Cost: linear in the cells, and in those of the lines.
/// @pre validate(options).ok()
[[nodiscard]] RegionGraph region_graph(const OccupancyGrid& grid, const RegionOptions& options);

}  // namespace cairn
