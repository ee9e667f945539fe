#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Points as offsets in cells from one cell.
struct CellOffsets {
  std::vector<Cell> cells;
  std::vector<std::int32_t> indices;  ///< The same, in a row-major array of cells.
  Cell low;                           ///< Lower left corner of all.
  Cell high;                          ///< Upper right corner of all.

  void add(Cell cell, int map_width);
};

/// Values of cells in [0, 255], and their maxima over squares of 2, 4, 8 ... cells a side that
/// begin at each cell.
///
/// Source: Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016, Sec. V-B (16).
class MaxPyramid {
 public:
  static constexpr int kLevels = 7;

  MaxPyramid() = default;
  /// @param levels how many are made, [1, kLevels]; the others must not be asked for
  /// @pre values.size() == geometry.cell_count()
  MaxPyramid(const GridGeometry& geometry, std::vector<std::uint8_t> values, int levels = kLevels);

  /// The maximum over the square of 2^level cells a side, as far as it lies on the map.
  /// @pre geometry.contains(low), level in [0, kLevels)
  [[nodiscard]] std::uint8_t greatest(Cell low, int level) const {
    return levels_[static_cast<std::size_t>(level)][geometry_.index_of(low)];
  }
  /// The most that the values at the offsets can sum up to, from any cell of a square. Exact at
  /// level 0. Cells beyond the map count nothing.
  /// @pre geometry.contains(low), level in [0, kLevels), the offsets were added with its width
  [[nodiscard]] std::int32_t greatest_sum(const CellOffsets& offsets, Cell low, int level) const;

 private:
  GridGeometry geometry_;
  std::vector<std::vector<std::uint8_t>> levels_;
};

}  // namespace cairn
