#include <algorithm>
#include <cmath>
#include <string>

#include "base/check.hpp"
#include "global_map/global_map.hpp"

namespace cairn {

Result<OccupancyGrid> GlobalMap::empty_grid(std::size_t max_cells) const {
  GridGeometry geometry;
  geometry.cell_m = options_.cell_m;
  if (tiles_.empty()) {
    return OccupancyGrid(geometry);
  }
  const int side = options_.tile_cells;
  TileIndex lower = tiles_.begin()->first;
  TileIndex upper = lower;
  for (const auto& [index, tile] : tiles_) {
    lower = {std::min(lower.x, index.x), std::min(lower.y, index.y)};
    upper = {std::max(upper.x, index.x), std::max(upper.y, index.y)};
  }
  const double columns = (1.0 + upper.x - lower.x) * side;
  const double rows = (1.0 + upper.y - lower.y) * side;
  if (columns * rows > static_cast<double>(max_cells)) {
    return Error{ErrorCode::kUnavailable, "global map: " + std::to_string(columns) + " x " +
                                              std::to_string(rows) + " cells are too many"};
  }
  geometry.width = static_cast<int>(columns);
  geometry.height = static_cast<int>(rows);
  geometry.origin_m = side * options_.cell_m * Vector2d(lower.x, lower.y);
  return OccupancyGrid(geometry);
}

void GlobalMap::copy_tile(TileIndex index, OccupancyGrid* grid) const {
  const auto found = tiles_.find(index);
  if (found == tiles_.end()) {
    return;
  }
  const int side = options_.tile_cells;
  const Vector2d corner_m = side * options_.cell_m * Vector2d(index.x, index.y);
  const Vector2d away = (corner_m - grid->geometry().origin_m) / options_.cell_m;
  const Cell low{static_cast<int>(std::lround(away.x())), static_cast<int>(std::lround(away.y()))};
  CAIRN_CHECK(grid->contains(low) && grid->contains({low.x + side - 1, low.y + side - 1}));
  const std::int32_t* hits = found->second.hits.data();
  const std::int32_t* misses = found->second.misses.data();
  for (int y = low.y; y < low.y + side; ++y) {
    OccupancyGrid::LogOdds* const row = &grid->log_odds({low.x, y});
    for (int x = 0; x < side; ++x) {
      row[x] = static_cast<OccupancyGrid::LogOdds>(
          std::lround(OccupancyGrid::kLogOddsPerUnit * log_odds_of(*hits++, *misses++)));
    }
  }
}

Result<OccupancyGrid> GlobalMap::to_grid(std::size_t max_cells) const {
  Result<OccupancyGrid> grid = empty_grid(max_cells);
  if (grid) {
    for (const auto& [index, tile] : tiles_) {
      copy_tile(index, &*grid);
    }
  }
  return grid;
}

}  // namespace cairn
