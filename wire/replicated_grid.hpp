#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "wire/wire_check.hpp"

namespace cairn_lcm {
class grid_map_t;
}

namespace cairn::wire {

/// Which tile: (0, 0) has its lower left corner at the origin of the frame.
struct TileIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

/// Row by row, y up: occupancy in percent, 255 unknown; tile_cells^2 of them. Shared, since a tile
/// that did not change is the same in many revisions.
using TileCells = std::shared_ptr<const Bytes>;

/// An occupancy grid as daemon and clients hold it in common: what a grid_map_t says.
struct ReplicatedGrid {
  std::int64_t utime = 0;  ///< Of the last change.
  std::int64_t map_id = 0;
  std::int64_t revision = 0;
  double cell_m = 0.0;
  std::int32_t tile_cells = 0;
  std::map<TileIndex, TileCells> tiles;
};

/// Cells along the side of a tile, at most.
inline constexpr std::int32_t kMaxTileCells = 1024;
[[nodiscard]] bool is_tiling(double cell_m, std::int32_t tile_cells);

[[nodiscard]] cairn_lcm::grid_map_t to_message(const ReplicatedGrid& grid);
/// Nothing where sizes do not fit together.
[[nodiscard]] Expected<ReplicatedGrid> to_grid(const cairn_lcm::grid_map_t& message);

}  // namespace cairn::wire
