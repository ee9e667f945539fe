#include "wire/replicated_grid.hpp"

#include <cmath>

#include <cairn_lcm/grid_map_t.hpp>

namespace cairn::wire {

cairn_lcm::grid_map_t to_message(const ReplicatedGrid& grid) {
  cairn_lcm::grid_map_t message{};
  message.utime = grid.utime;
  message.map_id = grid.map_id;
  message.revision = grid.revision;
  message.cell_m = grid.cell_m;
  message.tile_cells = grid.tile_cells;
  message.num_tiles = static_cast<std::int32_t>(grid.tiles.size());
  message.tiles.reserve(grid.tiles.size());
  for (const auto& [index, cells] : grid.tiles) {
    cairn_lcm::tile_t& tile = message.tiles.emplace_back();
    tile.tile_x = index.x;
    tile.tile_y = index.y;
    tile.num_cells = static_cast<std::int32_t>(cells->size());
    tile.cells = *cells;
  }
  return message;
}

Expected<ReplicatedGrid> to_grid(const cairn_lcm::grid_map_t& message) {
  using Grid = Expected<ReplicatedGrid>;
  if (message.num_tiles > 0 && !is_tiling(message.cell_m, message.tile_cells)) {
    return Grid::failure("grid with impossible cells or tiles");
  }
  ReplicatedGrid grid{message.utime,  message.map_id,     message.revision,
                      message.cell_m, message.tile_cells, {}};
  for (const cairn_lcm::tile_t& tile : message.tiles) {
    if (std::int64_t{tile.num_cells} != std::int64_t{grid.tile_cells} * grid.tile_cells) {
      return Grid::failure("grid with a tile of wrong size");
    }
    grid.tiles[{tile.tile_x, tile.tile_y}] = std::make_shared<const Bytes>(tile.cells);
  }
  return grid;
}

bool is_tiling(double cell_m, std::int32_t tile_cells) {
  return std::isfinite(cell_m) && cell_m > 0.0 && tile_cells >= 1 && tile_cells <= kMaxTileCells;
}

}  // namespace cairn::wire
