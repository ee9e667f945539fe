#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Values of cells in [0, 255], and their maxima over squares of 1, 2, 3, 4, 6 ... 32 cells a side
/// that begin at each cell: bounds for whatever comes to lie in such a square. Cells beyond the map
/// count nothing. All maxima are one array, so that one number names a square at its place.
///
/// Source: Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016, Sec. V-B (16); sides
/// between the powers of two since a scan that is turned a little needs a little more.
/// Memory: 10 bytes per cell, of the map and of a rim of 32 cells.
class SquareMaxima {
 public:
  static constexpr std::array<int, 10> kSides_cells{1, 2, 3, 4, 6, 8, 12, 16, 24, 32};
  static constexpr int kWidest_cells = kSides_cells.back();

  SquareMaxima() = default;
  /// @pre values.size() == geometry.cell_count()
  SquareMaxima(const GridGeometry& geometry, const std::vector<std::uint8_t>& values);
  /// All values are 0, until they are filled in and widened.
  explicit SquareMaxima(const GridGeometry& geometry);

  /// The values of a row of the map.
  [[nodiscard]] std::uint8_t* row(int y) {
    return &values_[static_cast<std::size_t>(index_of({0, y}))];
  }
  /// Makes the squares of a kind. @pre all values are filled in, and all kinds below are made
  void widen(int kind);

  /// The smallest kind of squares whose side is no less. @pre side_cells in [1, kWidest_cells]
  [[nodiscard]] static int kind_for(int side_cells);
  /// What to add to the index of a cell for that of the square of a kind which begins so far away.
  /// @pre the map has cells
  [[nodiscard]] std::int32_t offset_of(int kind, int x_cells, int y_cells) const {
    return kind * plane_ + y_cells * stride_ + x_cells;
  }
  /// @pre is_inside(cell)
  [[nodiscard]] std::int32_t index_of(Cell cell) const {
    return (cell.y + kWidest_cells) * stride_ + cell.x + kWidest_cells;
  }
  /// Whether squares of every kind that begin here have an index.
  [[nodiscard]] bool is_inside(Cell cell) const {
    return cell.x >= -kWidest_cells && cell.y >= -kWidest_cells && cell.x <= width_ &&
           cell.y <= height_;
  }
  /// The nearest cell that is inside: what begins there is as great as what begins at the cell.
  [[nodiscard]] Cell inside(Cell cell) const;
  /// By index and offset.
  [[nodiscard]] const std::uint8_t* values() const { return values_.get(); }

 private:
  int width_ = 0;  // of the map
  int height_ = 0;
  std::int32_t stride_ = 0;                 // cells from one row to the next
  std::int32_t plane_ = 0;                  // cells from one kind of squares to the next
  std::unique_ptr<std::uint8_t[]> values_;  // of a kind that was not made yet: anything
};

}  // namespace cairn
