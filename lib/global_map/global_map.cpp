#include "global_map/global_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr double kFarthest_m = 1e6;
/// Log odds beyond which more evidence changes nothing: 99.3 %.
constexpr double kMaxLogOdds = 5.0;
/// Counts of hits and of misses below which the percentage is looked up.
constexpr int kTabulated = 64;

int floored_quotient(int value, int divisor) {
  return value >= 0 ? value / divisor : -((divisor - 1 - value) / divisor);
}

std::uint8_t percent_of_log_odds(double log_odds) {
  const double probability = 1.0 / (1.0 + std::exp(-log_odds));
  return static_cast<std::uint8_t>(std::lround(100.0 * probability));
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
  percent_of_counts_.reserve(kTabulated * kTabulated);
  for (int hits = 0; hits < kTabulated; ++hits) {
    for (int misses = 0; misses < kTabulated; ++misses) {
      percent_of_counts_.push_back(percent_of_log_odds(log_odds_of(hits, misses)));
    }
  }
  percent_of_counts_.front() = kUnknownPercent;
}

/// The tiles drawn on last: a scan stays in a tile for some cells, and comes back to it in every
/// row of them.
class GlobalMap::RecentTiles {
 public:
  explicit RecentTiles(GlobalMap* map) : map_(map), side_(map->options_.tile_cells) {}

  /// The tile of a cell, as GlobalMap::tile_to_draw_on.
  Tile* at(Cell cell) {
    if (cell.x < corner_.x || cell.x >= corner_.x + side_ || cell.y < corner_.y ||
        cell.y >= corner_.y + side_ || !is_any_) {
      go_to({floored_quotient(cell.x, side_), floored_quotient(cell.y, side_)});
    }
    return tile_;
  }
  /// The lowest cell of the tile asked for last.
  [[nodiscard]] Cell corner() const { return corner_; }
  /// Of a cell in the tile asked for last.
  [[nodiscard]] std::size_t number_of(Cell cell) const {
    return static_cast<std::size_t>((cell.y - corner_.y) * side_ + cell.x - corner_.x);
  }

 private:
  struct Entry {
    TileIndex index{std::numeric_limits<int>::min(), 0};  // of no tile
    Tile* tile = nullptr;
  };

  void go_to(TileIndex index) {
    constexpr unsigned kSide = 8;
    Entry& entry = entries_[kSide * (static_cast<unsigned>(index.y) % kSide) +
                            static_cast<unsigned>(index.x) % kSide];
    if (entry.index != index) {
      entry = {index, map_->tile_to_draw_on(index)};
    }
    tile_ = entry.tile;
    corner_ = {index.x * side_, index.y * side_};
    is_any_ = true;
  }

  GlobalMap* map_;
  int side_;
  std::array<Entry, 64> entries_;  // by the low bits of the index
  Tile* tile_ = nullptr;
  Cell corner_;
  bool is_any_ = false;
};

std::vector<TileIndex> GlobalMap::draw(const std::vector<PosedScan>& scans) {
  const std::size_t unchanged = unchanged_count(scans);
  std::unordered_map<const LaserScan*, std::size_t> drawn_at;
  for (std::size_t i = unchanged; i < drawn_.size(); ++i) {
    drawn_at.emplace(drawn_[i].scan.get(), i);
  }
  RecentTiles recent(this);
  std::vector<bool> is_kept(drawn_.size(), false);
  std::vector<PosedScan> wanted(scans.begin() + static_cast<std::ptrdiff_t>(unchanged),
                                scans.end());
  for (PosedScan& scan : wanted) {
    CAIRN_CHECK(scan.scan != nullptr);
    const auto found = drawn_at.find(scan.scan.get());
    if (found != drawn_at.end() && !is_kept[found->second] &&
        is_drawn_well(drawn_[found->second].T_global_robot, scan.T_global_robot)) {
      is_kept[found->second] = true;
      scan.T_global_robot = drawn_[found->second].T_global_robot;
    } else {
      count(scan, 1, &recent);
    }
  }
  for (std::size_t i = unchanged; i < drawn_.size(); ++i) {
    if (!is_kept[i]) {
      count(drawn_[i], -1, &recent);
    }
  }
  drawn_.resize(unchanged);
  drawn_.insert(drawn_.end(), std::make_move_iterator(wanted.begin()),
                std::make_move_iterator(wanted.end()));
  return take_changed();
}

/// How many of the first scans are drawn already, in the same order: nearly all, most of the time.
std::size_t GlobalMap::unchanged_count(const std::vector<PosedScan>& scans) const {
  const std::size_t common = std::min(scans.size(), drawn_.size());
  std::size_t i = 0;
  while (i < common && scans[i].scan == drawn_[i].scan &&
         is_drawn_well(drawn_[i].T_global_robot, scans[i].T_global_robot)) {
    ++i;
  }
  return i;
}

bool GlobalMap::is_drawn_well(const Pose2& drawn, const Pose2& wanted) const {
  const double x_m = wanted.x() - drawn.x();
  const double y_m = wanted.y() - drawn.y();
  const double turn_rad = wanted.theta() - drawn.theta();
  return x_m * x_m + y_m * y_m <= options_.moved_m * options_.moved_m &&
         (std::abs(turn_rad) <= options_.turned_rad ||  // Most often; wrapping takes long.
          std::abs(wrap_angle(turn_rad)) <= options_.turned_rad);
}

/// Adds the evidence of a scan so many times; takes it out for -1.
void GlobalMap::count(const PosedScan& scan, std::int32_t times, RecentTiles* recent) {
  if (!can_be_drawn(scan.T_global_robot)) {
    return;
  }
  const TouchedCells& touched =
      footprint_.of(*scan.scan, scan.T_global_robot * scan.scan->T_robot_laser);
  for (const Cell& hit : touched.hits) {
    if (Tile* const tile = recent->at(hit)) {
      tile->hits[recent->number_of(hit)] += times;
    } else {
      cells_beyond_budget_ += times > 0 ? 1 : 0;
    }
  }
  for (const CellSpan& span : touched.passed) {
    count_misses(span, times, recent);
  }
}

void GlobalMap::count_misses(const CellSpan& span, std::int32_t times, RecentTiles* recent) {
  const int side = options_.tile_cells;
  for (int x = span.begin_x; x < span.end_x;) {
    const Cell at{x, span.y};
    Tile* const tile = recent->at(at);
    const int end_x = std::min(span.end_x, recent->corner().x + side);
    if (tile != nullptr) {
      std::int32_t* const misses = &tile->misses[recent->number_of(at)];
      for (int i = 0; i < end_x - x; ++i) {
        misses[i] += times;
      }
    } else {
      cells_beyond_budget_ += times > 0 ? end_x - x : 0;
    }
    x = end_x;
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
    found = tiles_.emplace(index, Tile(side * side)).first;
  }
  if (!found->second.is_changed) {
    found->second.is_changed = true;
    changed_.push_back(index);
  }
  return &found->second;
}

std::vector<TileIndex> GlobalMap::take_changed() {
  std::sort(changed_.begin(), changed_.end());
  for (const TileIndex& index : changed_) {
    tiles_.find(index)->second.is_changed = false;
  }
  return std::exchange(changed_, {});
}

std::vector<TileIndex> GlobalMap::tiles() const {
  std::vector<TileIndex> indices;
  for (const auto& [index, tile] : tiles_) {
    indices.push_back(index);
  }
  return indices;
}

double GlobalMap::log_odds_of(std::int32_t hits, std::int32_t misses) const {
  return std::clamp(hits * options_.hit_log_odds - misses * options_.miss_log_odds, -kMaxLogOdds,
                    kMaxLogOdds);
}

std::vector<std::uint8_t> GlobalMap::percent_of(TileIndex tile) const {
  const auto side = static_cast<std::size_t>(options_.tile_cells);
  std::vector<std::uint8_t> percent(side * side, kUnknownPercent);
  const auto found = tiles_.find(tile);
  if (found == tiles_.end()) {
    return percent;
  }
  const Tile& drawn = found->second;
  for (std::size_t i = 0; i < percent.size(); ++i) {
    const std::int32_t hits = drawn.hits[i];
    const std::int32_t misses = drawn.misses[i];
    if (hits < kTabulated && misses < kTabulated) {
      percent[i] = percent_of_counts_[static_cast<std::size_t>(kTabulated * hits + misses)];
    } else {
      percent[i] = percent_of_log_odds(log_odds_of(hits, misses));
    }
  }
  return percent;
}

}  // namespace cairn
