#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "geometry/pose2.hpp"

namespace cairn {

/// Column and row of a cell; x to the right, y up, as in the map's frame.
struct Cell {
  int x = 0;
  int y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// Where the cells of a grid lie in its frame: cell (0, 0) has its lower left corner at `origin`.
struct GridGeometry {
  double cell_m = 0.05;
  Vector2d origin_m = Vector2d::Zero();
  int width = 0;   ///< cells along x
  int height = 0;  ///< cells along y

  [[nodiscard]] bool contains(Cell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height;
  }
  [[nodiscard]] Cell cell_at(const Vector2d& p) const {
    return {static_cast<int>(std::floor((p.x() - origin_m.x()) / cell_m)),
            static_cast<int>(std::floor((p.y() - origin_m.y()) / cell_m))};
  }
  [[nodiscard]] Vector2d center_of(Cell c) const {
    return origin_m + cell_m * Vector2d(c.x + 0.5, c.y + 0.5);
  }
  /// @pre contains(c)
  [[nodiscard]] std::size_t index_of(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// An occupancy grid: for every cell the log odds that it is occupied, as a fixed-point number so
/// that sums are exact and the same on every machine. 0 says nothing is known.
///
/// Source: Moravec and Elfes' occupancy grids as used in Kuipers et al., ICRA 2004, Sec. III-A.
class OccupancyGrid {
 public:
  using LogOdds = std::int16_t;
  static constexpr int kLogOddsPerUnit = 100;  ///< The stored number is 100 x the natural log odds.
  static constexpr LogOdds kOccupiedAbove = 40;  ///< Stored log odds above which a cell is a wall.
  static constexpr LogOdds kFreeBelow = -40;

  OccupancyGrid() = default;
  explicit OccupancyGrid(const GridGeometry& geometry)
      : geometry_(geometry), log_odds_(geometry.cell_count(), LogOdds{0}) {}

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  /// Lays the grid elsewhere in its frame; the cells stay as they are.
  void move_origin(const Vector2d& origin_m) { geometry_.origin_m = origin_m; }
  [[nodiscard]] bool contains(Cell c) const { return geometry_.contains(c); }

  /// @pre contains(c)
  [[nodiscard]] LogOdds log_odds(Cell c) const { return log_odds_[geometry_.index_of(c)]; }
  [[nodiscard]] LogOdds& log_odds(Cell c) { return log_odds_[geometry_.index_of(c)]; }

  /// Unknown outside of the grid.
  [[nodiscard]] CellState state(Cell c) const {
    if (!contains(c)) {
      return CellState::kUnknown;
    }
    const LogOdds value = log_odds(c);
    if (value > kOccupiedAbove) {
      return CellState::kOccupied;
    }
    return value < kFreeBelow ? CellState::kFree : CellState::kUnknown;
  }

  [[nodiscard]] const std::vector<LogOdds>& cells() const { return log_odds_; }
  [[nodiscard]] std::vector<LogOdds>& cells() { return log_odds_; }

 private:
  GridGeometry geometry_;
  std::vector<LogOdds> log_odds_;
};

}  // namespace cairn
