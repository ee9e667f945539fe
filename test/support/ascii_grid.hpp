#pragma once

#include <string>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn::test {

/// A grid drawn as text, top line = largest y: '#' wall, '.' or ' ' free, '?' unknown. The lower
/// left corner of the drawing is the origin.
inline OccupancyGrid grid_of(const std::vector<std::string>& lines, double cell_m) {
  GridGeometry geometry;
  geometry.cell_m = cell_m;
  geometry.height = static_cast<int>(lines.size());
  geometry.width = lines.empty() ? 0 : static_cast<int>(lines.front().size());
  OccupancyGrid grid(geometry);
  for (int y = 0; y < geometry.height; ++y) {
    const std::string& line = lines[static_cast<std::size_t>(geometry.height - 1 - y)];
    for (int x = 0; x < geometry.width; ++x) {
      const char drawn = line.at(static_cast<std::size_t>(x));
      if (drawn != '?') {
        grid.log_odds({x, y}) =
            drawn == '#' ? OccupancyGrid::LogOdds{300} : OccupancyGrid::LogOdds{-300};
      }
    }
  }
  return grid;
}

}  // namespace cairn::test
