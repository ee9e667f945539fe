#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <cairn_lcm/grid_map_t.hpp>

#include "global_map/global_map.hpp"
#include "service/map_state.hpp"
#include "transport/map_messages.hpp"
#include "wire/replicated_grid.hpp"

namespace cairn {

/// The documents of one moment, by what they are (snapshot_request_t).
struct Documents {
  std::int64_t revision = 0;
  std::map<int, std::vector<std::uint8_t>> bytes;
};

/// The documents that need no drawing: topology, hypotheses, trajectory.
[[nodiscard]] Documents documents_without_drawing(const MapState& state, const Sender& sender);

/// Draws the global map from immutable pictures of the map, and makes the documents that clients
/// and the map file get. One owner: the solver thread, or a replay.
class MapMaker {
 public:
  explicit MapMaker(const GlobalMapOptions& options);

  /// Draws what changed since the last time.
  /// @return the tiles that look different now
  std::map<wire::TileIndex, wire::TileCells> draw(const MapState& state);

  /// All tiles, as they are now.
  [[nodiscard]] cairn_lcm::grid_map_t grid_map(const Sender& sender);
  /// Everything that is stored, as it is now.
  [[nodiscard]] Documents documents(const MapState& state, const Sender& sender);

  [[nodiscard]] const GlobalMap& map() const { return map_; }
  [[nodiscard]] const GlobalMapOptions& options() const { return map_.options(); }

 private:
  GlobalMap map_;
  wire::ReplicatedGrid grid_;
};

/// The scans that are worth drawing: a robot that stands adds nothing by seeing the same again.
[[nodiscard]] std::vector<PosedScan> scans_worth_drawing(const std::vector<PosedScan>& trajectory);

/// An occupancy grid as whole tiles of its own frame, as percent: the local map for clients.
[[nodiscard]] wire::ReplicatedGrid to_tiles(const OccupancyGrid& grid, int tile_cells);

}  // namespace cairn
