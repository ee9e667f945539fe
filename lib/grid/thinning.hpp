#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// A set of cells of a rectangle, row by row from below.
struct CellMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< 1 in the set, 0 not.

  CellMask() = default;
  CellMask(int width_cells, int height_cells)
      : width(width_cells),
        height(height_cells),
        cells(static_cast<std::size_t>(width_cells) * static_cast<std::size_t>(height_cells)) {}

  [[nodiscard]] std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  /// No cell outside of the rectangle is in the set.
  [[nodiscard]] bool has(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && cells[index_of(x, y)] != 0;
  }
};

/// A set of cells of a rectangle with an empty cell all around, so that every cell of it has eight
/// neighbours. Its cells are named by their index in the rectangle with that rim.
class PaddedCells {
 public:
  /// Makes it an empty set of such a rectangle.
  void clear(int width, int height) {
    width_ = static_cast<std::size_t>(width) + 2;
    cells_.assign(width_ * (static_cast<std::size_t>(height) + 2), 0);
  }

  [[nodiscard]] std::size_t index_of(std::size_t x, std::size_t y) const {
    return (y + 1) * width_ + x + 1;
  }
  /// Column and row in the rectangle without the rim.
  [[nodiscard]] Cell cell_of(std::size_t index) const {
    // Divides in 32 bits, which is much faster; a set of more cells fits into no memory.
    const auto at = static_cast<std::uint32_t>(index);
    const auto width = static_cast<std::uint32_t>(width_);
    return {static_cast<int>(at % width) - 1, static_cast<int>(at / width) - 1};
  }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] std::size_t stride() const { return width_; }
  [[nodiscard]] bool has(std::size_t index) const { return cells_[index] != 0; }
  void add(std::size_t index) { cells_[index] = 1; }
  void remove(std::size_t index) { cells_[index] = 0; }
  void put(std::size_t index, bool has) { cells_[index] = has ? 1 : 0; }
  /// Moves the set along with the ground; see shift_rows.
  void shift(Cell moved);
  [[nodiscard]] const std::uint8_t* data() const { return cells_.data(); }
  [[nodiscard]] std::uint8_t* data() { return cells_.data(); }

  /// The eight neighbours of a cell as bits, counterclockwise from the east.
  [[nodiscard]] unsigned neighbours_of(std::size_t index) const {
    const std::uint8_t* const own = cells_.data() + index;
    const std::uint8_t* const above = own + width_;
    const std::uint8_t* const below = own - width_;
    return unsigned{own[1]} | unsigned{above[1]} << 1U | unsigned{above[0]} << 2U |
           unsigned{above[-1]} << 3U | unsigned{own[-1]} << 4U | unsigned{below[-1]} << 5U |
           unsigned{below[0]} << 6U | unsigned{below[1]} << 7U;
  }

 private:
  std::size_t width_ = 0;
  std::vector<std::uint8_t> cells_;
};

/// Whether a cell with these neighbours can be taken away without any change of topology.
[[nodiscard]] bool is_simple(unsigned neighbours);

/// Thins lines that may be two cells wide to one, pass by pass, but not at their ends.
/// @param order indices of all cells of the set, the first to be removed first; those that stay
///     are left in it
void thin_lines(std::vector<std::uint32_t>* order, PaddedCells* set);

}  // namespace cairn
