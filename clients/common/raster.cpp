#include "clients/common/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr std::int64_t kMostCells = std::int64_t{1} << 28;
constexpr std::int32_t kMostTileCells = 1 << 14;
constexpr std::int64_t kFarthestTile = std::int64_t{1} << 24;

/// Corners of the part of the grid that is known, in cells; the upper ones are exclusive.
struct Bounds {
  std::int64_t x_low = std::numeric_limits<std::int64_t>::max();
  std::int64_t y_low = std::numeric_limits<std::int64_t>::max();
  std::int64_t x_high = std::numeric_limits<std::int64_t>::min();
  std::int64_t y_high = std::numeric_limits<std::int64_t>::min();

  [[nodiscard]] bool empty() const { return x_low >= x_high; }
};

void check(const cairn_lcm::grid_map_t& map) {
  if (!(map.cell_m > 0.0) || !std::isfinite(map.cell_m)) {
    throw Failure(ExitCode::kBadData, "grid map: cell_m must be > 0, is " + fixed(map.cell_m, 6));
  }
  if (map.num_tiles > 0 && (map.tile_cells < 1 || map.tile_cells > kMostTileCells)) {
    throw Failure(ExitCode::kBadData, "grid map: tile_cells must be in [1, " +
                                          std::to_string(kMostTileCells) + "], is " +
                                          std::to_string(map.tile_cells));
  }
  const std::int64_t per_tile = std::int64_t{map.tile_cells} * map.tile_cells;
  for (const cairn_lcm::tile_t& tile : map.tiles) {
    if (tile.num_cells != per_tile || std::abs(std::int64_t{tile.tile_x}) > kFarthestTile ||
        std::abs(std::int64_t{tile.tile_y}) > kFarthestTile) {
      throw Failure(ExitCode::kBadData, "grid map: tile (" + std::to_string(tile.tile_x) + ", " +
                                            std::to_string(tile.tile_y) + ") has " +
                                            std::to_string(tile.num_cells) + " cells, expected " +
                                            std::to_string(per_tile));
    }
  }
}

/// Calls `use(x, y, cell)` for every known cell, in cells of the whole grid.
template <typename Use>
void for_each_known_cell(const cairn_lcm::grid_map_t& map, const Use& use) {
  for (const cairn_lcm::tile_t& tile : map.tiles) {
    const std::int64_t left = std::int64_t{tile.tile_x} * map.tile_cells;
    const std::int64_t bottom = std::int64_t{tile.tile_y} * map.tile_cells;
    std::size_t i = 0;
    for (std::int64_t y = 0; y < map.tile_cells; ++y) {
      for (std::int64_t x = 0; x < map.tile_cells; ++x, ++i) {
        if (tile.cells[i] != kUnknownCell) {
          use(left + x, bottom + y, tile.cells[i]);
        }
      }
    }
  }
}

Bounds known_bounds(const cairn_lcm::grid_map_t& map) {
  Bounds bounds;
  for_each_known_cell(map, [&](std::int64_t x, std::int64_t y, std::uint8_t) {
    bounds.x_low = std::min(bounds.x_low, x);
    bounds.y_low = std::min(bounds.y_low, y);
    bounds.x_high = std::max(bounds.x_high, x + 1);
    bounds.y_high = std::max(bounds.y_high, y + 1);
  });
  return bounds;
}

}  // namespace

Raster raster_of(const cairn_lcm::grid_map_t& map) {
  check(map);
  Raster raster;
  raster.cell_m = map.cell_m;
  const Bounds bounds = known_bounds(map);
  if (bounds.empty()) {
    return raster;
  }
  const std::int64_t width = bounds.x_high - bounds.x_low;
  const std::int64_t height = bounds.y_high - bounds.y_low;
  if (width > kMostCells / height) {
    throw Failure(ExitCode::kBadData, "grid map: " + std::to_string(width) + " x " +
                                          std::to_string(height) + " cells are too many");
  }
  raster.origin_x_m = static_cast<double>(bounds.x_low) * map.cell_m;
  raster.origin_y_m = static_cast<double>(bounds.y_low) * map.cell_m;
  raster.width = static_cast<int>(width);
  raster.height = static_cast<int>(height);
  raster.cells.assign(static_cast<std::size_t>(width * height), kUnknownCell);
  for_each_known_cell(map, [&](std::int64_t x, std::int64_t y, std::uint8_t cell) {
    const std::int64_t i = (y - bounds.y_low) * width + (x - bounds.x_low);
    raster.cells[static_cast<std::size_t>(i)] = std::min<std::uint8_t>(cell, 100);
  });
  return raster;
}

}  // namespace cairn::clients
