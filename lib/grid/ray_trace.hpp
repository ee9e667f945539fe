#pragma once

#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Appends to `cells` every cell of the grid that the segment from one point to another passes
/// through, in the order of passage, the cells of both ends included. What lies outside of the
/// grid is left out.
///
/// Consecutive cells share a side. A segment through a corner of cells takes one of the two ways
/// around it.
///
/// Source: Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics
/// 1987.
/// @pre the coordinates are finite
/// Cost: linear in the number of cells within the grid.
void trace_ray(const GridGeometry& geometry,
               const Vector2d& from,
               const Vector2d& to,
               std::vector<Cell>* cells);

}  // namespace cairn
