#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "global_map/scan_footprint.hpp"
#include "grid/occupancy_grid.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// Column and row of a tile: tile (0, 0) has its lower left corner at the origin of the frame.
struct TileIndex {
  int x = 0;
  int y = 0;
  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

/// A scan and where it was taken.
struct PosedScan {
  std::shared_ptr<const LaserScan> scan;  ///< Shared and immutable: its address names it. Not null.
  Pose2 T_global_robot;
  bool is_trusted = true;  ///< Whether maps may be drawn from it; one that is not is a pose only.
};

/// Tuning of the global map. In the configuration file: the object "global_map".
struct GlobalMapOptions {
  double cell_m = 0.05;         ///< > 0
  int tile_cells = 64;          ///< Cells along the side of a tile. [8, 1024]
  double draw_range_m = 10.0;   ///< Beams are drawn up to here. (0, 100]
  double hit_log_odds = 1.35;   ///< A scan ends a beam in the cell. (0, 10]
  double miss_log_odds = 0.45;  ///< A scan sees through the cell. (0, 10]
  double moved_m = 0.01;        ///< A scan moved by no more stays as it is drawn. >= 0
  double turned_rad = 0.002;    ///< The same for its heading. >= 0
  int max_tiles = 65536;        ///< What lies beyond this budget is not drawn. [1, 1000000]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalMapOptions& options);

/// The global metrical map: an occupancy grid in square tiles, drawn from scans at the poses of the
/// trajectory H(x).
///
/// Each scan adds one piece of evidence to every cell it touches: "hit" where a beam ends, else
/// "miss" where one passes. The evidence is counted in whole numbers, so a scan can be taken out
/// again exactly: a map whose scans moved equals the one drawn afresh, and costs only the scans
/// that moved.
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-F; Moravec and Elfes' occupancy grids.
class GlobalMap {
 public:
  static constexpr std::uint8_t kUnknownPercent = 255;

  /// @pre validate(options).ok()
  explicit GlobalMap(const GlobalMapOptions& options = {});

  /// Makes the map show exactly these scans. Scans that are new, gone, or have moved are drawn or
  /// taken out; all others stay. A scan whose pose is not finite, or beyond 1e6 m, is not drawn.
  /// @return the tiles that changed, in order
  std::vector<TileIndex> draw(const std::vector<PosedScan>& scans);

  /// All tiles that were ever drawn on, in order.
  [[nodiscard]] std::vector<TileIndex> tiles() const;

  /// The cells of a tile, row by row, y up: occupancy in percent, 0 to 100, or kUnknownPercent.
  /// All unknown for a tile that was never drawn on.
  [[nodiscard]] std::vector<std::uint8_t> percent_of(TileIndex tile) const;

  /// All tiles as one grid, for planning. kUnavailable where it would have more than `max_cells`.
  [[nodiscard]] Result<OccupancyGrid> to_grid(std::size_t max_cells = 100'000'000) const;

  /// The same without any tile yet: what is unknown everywhere.
  [[nodiscard]] Result<OccupancyGrid> empty_grid(std::size_t max_cells) const;
  /// One tile of it. @pre the grid is of this map and of its tiles as they are
  void copy_tile(TileIndex index, OccupancyGrid* grid) const;

  [[nodiscard]] const GlobalMapOptions& options() const { return options_; }
  /// How often a scan touched a cell that was not drawn for want of tiles.
  [[nodiscard]] std::int64_t cells_beyond_budget() const { return cells_beyond_budget_; }

 private:
  /// Evidence by cell, row by row.
  struct Tile {
    explicit Tile(std::size_t cells) : hits(cells, 0), misses(cells, 0) {}
    std::vector<std::int32_t> hits;
    std::vector<std::int32_t> misses;
    bool is_changed = false;  ///< Is in changed_.
  };
  class RecentTiles;

  [[nodiscard]] std::size_t unchanged_count(const std::vector<PosedScan>& scans) const;
  void count(const PosedScan& scan, std::int32_t times, RecentTiles* recent);
  void count_misses(const CellSpan& span, std::int32_t times, RecentTiles* recent);
  [[nodiscard]] Tile* tile_to_draw_on(TileIndex index);
  [[nodiscard]] bool is_drawn_well(const Pose2& drawn, const Pose2& wanted) const;
  [[nodiscard]] double log_odds_of(std::int32_t hits, std::int32_t misses) const;
  std::vector<TileIndex> take_changed();

  GlobalMapOptions options_;
  ScanFootprint footprint_;
  std::vector<std::uint8_t> percent_of_counts_;  ///< By hits and misses, where both are small.
  std::map<TileIndex, Tile> tiles_;
  std::vector<TileIndex> changed_;  ///< Since the last time, each once.
  std::vector<PosedScan> drawn_;    ///< As they are drawn.
  std::int64_t cells_beyond_budget_ = 0;
};

}  // namespace cairn
