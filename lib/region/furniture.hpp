#pragma once

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// The grid without the furniture: connected pieces of cells that are not free, with free space all
/// around and no side longer than `size_m`, become free. Legs of chairs and tables would otherwise
/// narrow the free space within a room as if there were doors. Pieces that touch the border of the
/// grid stay.
/// Cost: linear in the cells.
[[nodiscard]] OccupancyGrid without_furniture(const OccupancyGrid& grid, double size_m);

}  // namespace cairn
