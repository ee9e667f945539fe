#include "runtime/map_maker.hpp"

#include <cmath>
#include <utility>

#include <cairn_lcm/snapshot_request_t.hpp>

#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {

std::vector<PosedScan> scans_worth_drawing(const std::vector<PosedScan>& trajectory) {
  constexpr double kMoved_m = 0.1;
  constexpr double kTurned_rad = 0.1;
  std::vector<PosedScan> worth;
  for (const PosedScan& posed : trajectory) {
    if (!posed.is_trusted) {
      continue;
    }
    if (!worth.empty()) {
      const Pose2& last = worth.back().T_global_robot;
      const Pose2& next = posed.T_global_robot;
      if ((next.translation() - last.translation()).norm() < kMoved_m &&
          std::abs(turn_between(last.theta(), next.theta())) < kTurned_rad) {
        continue;
      }
    }
    worth.push_back(posed);
  }
  return worth;
}

Documents documents_without_drawing(const MapState& state, const Sender& sender) {
  using What = cairn_lcm::snapshot_request_t;
  Documents documents;
  documents.revision = state.topology_revision;
  documents.bytes[What::TOPOLOGY] = wire::to_document(to_topology(state, sender));
  documents.bytes[What::HYPOTHESES] = wire::to_document(to_hypotheses(state, sender));
  documents.bytes[What::TRAJECTORY] = wire::to_document(to_trajectory(state, sender));
  documents.bytes[What::VISITS] = wire::to_document(to_visit_places(state, sender));
  return documents;
}

MapMaker::MapMaker(const GlobalMapOptions& options) : map_(options) {
  grid_.cell_m = options.cell_m;
  grid_.tile_cells = options.tile_cells;
}

std::map<wire::TileIndex, wire::TileCells> MapMaker::draw(const MapState& state) {
  std::map<wire::TileIndex, wire::TileCells> changed;
  for (const TileIndex& tile : map_.draw(scans_worth_drawing(state.trajectory))) {
    const wire::TileIndex index{tile.x, tile.y};
    wire::TileCells& held = grid_.tiles[index];
    wire::Bytes percent = map_.percent_of(tile);
    if (held == nullptr || *held != percent) {  // More of the same evidence may change nothing.
      held = std::make_shared<const wire::Bytes>(std::move(percent));
      changed[index] = held;
    }
  }
  if (!changed.empty()) {
    ++grid_.revision;
  }
  grid_.utime = utime_of(state.time);
  return changed;
}

cairn_lcm::grid_map_t MapMaker::grid_map(const Sender& sender) {
  grid_.map_id = sender.map_id;
  return wire::to_message(grid_);
}

Documents MapMaker::documents(const MapState& state, const Sender& sender) {
  using What = cairn_lcm::snapshot_request_t;
  Documents documents = documents_without_drawing(state, sender);
  documents.bytes[What::GLOBAL_MAP] = wire::to_document(grid_map(sender));
  return documents;
}

wire::ReplicatedGrid to_tiles(const OccupancyGrid& grid, int tile_cells) {
  const GridGeometry& geometry = grid.geometry();
  wire::ReplicatedGrid tiles;
  tiles.cell_m = geometry.cell_m;
  tiles.tile_cells = tile_cells;
  const auto side = static_cast<std::size_t>(tile_cells);
  // The window scrolls by whole cells, so its origin is a whole number of cells.
  const auto x0 = static_cast<int>(std::lround(geometry.origin_m.x() / geometry.cell_m));
  const auto y0 = static_cast<int>(std::lround(geometry.origin_m.y() / geometry.cell_m));
  std::map<wire::TileIndex, wire::Bytes> drawn;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const OccupancyGrid::LogOdds log_odds = grid.log_odds({x, y});
      if (log_odds == 0) {
        continue;
      }
      const auto tile_of = [tile_cells](int cell) {
        return cell >= 0 ? cell / tile_cells : -((-cell + tile_cells - 1) / tile_cells);
      };
      const wire::TileIndex index{tile_of(x0 + x), tile_of(y0 + y)};
      wire::Bytes& cells =
          drawn.try_emplace(index, side * side, GlobalMap::kUnknownPercent).first->second;
      const auto row = static_cast<std::size_t>(y0 + y - index.y * tile_cells);
      const auto column = static_cast<std::size_t>(x0 + x - index.x * tile_cells);
      const double odds = std::exp(static_cast<double>(log_odds) / OccupancyGrid::kLogOddsPerUnit);
      cells[row * side + column] =
          static_cast<std::uint8_t>(std::lround(100.0 * odds / (1.0 + odds)));
    }
  }
  for (auto& [index, cells] : drawn) {
    tiles.tiles[index] = std::make_shared<const wire::Bytes>(std::move(cells));
  }
  return tiles;
}

}  // namespace cairn
