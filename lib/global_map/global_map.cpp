#include "global_map/global_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr double kFarthest_m = 1e6;
/// Log odds beyond which more evidence changes nothing: 99.3 %.
constexpr double kMaxLogOdds = 5.0;

int floored_quotient(int value, int divisor) {
  return value >= 0 ? value / divisor : -((divisor - 1 - value) / divisor);
}

bool can_be_drawn(const Pose2& pose) {
  return std::abs(pose.x()) <= kFarthest_m && std::abs(pose.y()) <= kFarthest_m &&
         std::isfinite(pose.theta());
}

}  // namespace

Status validate(const GlobalMapOptions& options) {
  return Validator("global_map")
      .within("cell_m", options.cell_m, 0.005, 1.0)
      .within("tile_cells", options.tile_cells, 8, 1024)
      .within("draw_range_m", options.draw_range_m, 0.1, 100.0)
      .within("hit_log_odds", options.hit_log_odds, 0.01, 10.0)
      .within("miss_log_odds", options.miss_log_odds, 0.01, 10.0)
      .within("moved_m", options.moved_m, 0.0, 1.0)
      .within("turned_rad", options.turned_rad, 0.0, 1.0)
      .within("max_tiles", options.max_tiles, 1, 1'000'000)
      .status();
}

GlobalMap::GlobalMap(const GlobalMapOptions& options)
    : options_(options), footprint_(options.cell_m, options.draw_range_m) {
  CAIRN_CHECK(validate(options).ok());
}

std::vector<TileIndex> GlobalMap::draw(const std::vector<PosedScan>& scans) {
  std::unordered_map<const LaserScan*, std::size_t> drawn_at;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    drawn_at.emplace(drawn_[i].scan.get(), i);
  }
  std::vector<bool> is_kept(drawn_.size(), false);
  std::vector<PosedScan> wanted = scans;
  for (PosedScan& scan : wanted) {
    CAIRN_CHECK(scan.scan != nullptr);
    const auto found = drawn_at.find(scan.scan.get());
    if (found != drawn_at.end() && !is_kept[found->second] &&
        is_drawn_well(drawn_[found->second].T_global_robot, scan.T_global_robot)) {
      is_kept[found->second] = true;
      scan.T_global_robot = drawn_[found->second].T_global_robot;
    } else {
      count(scan, 1);
    }
  }
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    if (!is_kept[i]) {
      count(drawn_[i], -1);
    }
  }
  drawn_ = std::move(wanted);
  return take_changed();
}

bool GlobalMap::is_drawn_well(const Pose2& drawn, const Pose2& wanted) const {
  return std::hypot(wanted.x() - drawn.x(), wanted.y() - drawn.y()) <= options_.moved_m &&
         std::abs(turn_between(drawn.theta(), wanted.theta())) <= options_.turned_rad;
}

/// Adds the evidence of a scan so many times; takes it out for -1.
void GlobalMap::count(const PosedScan& scan, std::int32_t times) {
  if (!can_be_drawn(scan.T_global_robot)) {
    return;
  }
  const Pose2 T_global_laser = scan.T_global_robot * scan.scan->T_robot_laser;
  const int side = options_.tile_cells;
  Tile* tile = nullptr;
  Cell low{0, 0};   // of the tile
  Cell high{0, 0};  // beyond the tile
  for (const TouchedCell& touched : footprint_.of(*scan.scan, T_global_laser)) {
    const Cell& at = touched.cell;
    if (at.x < low.x || at.x >= high.x || at.y < low.y || at.y >= high.y) {
      const TileIndex index{floored_quotient(at.x, side), floored_quotient(at.y, side)};
      tile = tile_to_draw_on(index);
      low = {index.x * side, index.y * side};
      high = {low.x + side, low.y + side};
    }
    if (tile == nullptr) {
      cells_beyond_budget_ += times > 0 ? 1 : 0;
      continue;
    }
    Evidence& evidence =
        tile->cells[static_cast<std::size_t>((at.y - low.y) * side + at.x - low.x)];
    (touched.is_hit ? evidence.hits : evidence.misses) += times;
  }
}

/// Marks the tile as changed. None beyond the budget: as no tile is ever dropped, a scan is then
/// also taken out without it.
GlobalMap::Tile* GlobalMap::tile_to_draw_on(TileIndex index) {
  auto found = tiles_.find(index);
  if (found == tiles_.end()) {
    if (tiles_.size() >= static_cast<std::size_t>(options_.max_tiles)) {
      return nullptr;
    }
    const auto side = static_cast<std::size_t>(options_.tile_cells);
    found = tiles_.emplace(index, Tile{std::vector<Evidence>(side * side), false}).first;
  }
  found->second.is_changed = true;
  return &found->second;
}

std::vector<TileIndex> GlobalMap::take_changed() {
  std::vector<TileIndex> changed;
  for (auto& [index, tile] : tiles_) {
    if (tile.is_changed) {
      changed.push_back(index);
      tile.is_changed = false;
    }
  }
  return changed;
}

std::vector<TileIndex> GlobalMap::tiles() const {
  std::vector<TileIndex> indices;
  for (const auto& [index, tile] : tiles_) {
    indices.push_back(index);
  }
  return indices;
}

double GlobalMap::log_odds_of(const Evidence& evidence) const {
  return std::clamp(
      evidence.hits * options_.hit_log_odds - evidence.misses * options_.miss_log_odds,
      -kMaxLogOdds, kMaxLogOdds);
}

std::vector<std::uint8_t> GlobalMap::percent_of(TileIndex tile) const {
  const auto side = static_cast<std::size_t>(options_.tile_cells);
  std::vector<std::uint8_t> percent(side * side, kUnknownPercent);
  const auto found = tiles_.find(tile);
  if (found == tiles_.end()) {
    return percent;
  }
  for (std::size_t i = 0; i < percent.size(); ++i) {
    const Evidence& evidence = found->second.cells[i];
    if (evidence.hits > 0 || evidence.misses > 0) {
      const double probability = 1.0 / (1.0 + std::exp(-log_odds_of(evidence)));
      percent[i] = static_cast<std::uint8_t>(std::lround(100.0 * probability));
    }
  }
  return percent;
}

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
  const Evidence* evidence = found->second.cells.data();
  for (int y = low.y; y < low.y + side; ++y) {
    OccupancyGrid::LogOdds* const row = &grid->log_odds({low.x, y});
    for (int x = 0; x < side; ++x) {
      row[x] = static_cast<OccupancyGrid::LogOdds>(
          std::lround(OccupancyGrid::kLogOddsPerUnit * log_odds_of(*evidence++)));
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
