#pragma once

#include <cstdint>
#include <vector>

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

/// Thins a set to lines: removes cells one by one in the given order, as often as needed, where
/// that changes the topology of neither the set (8-connected) nor its complement (4-connected).
/// Cells of `kept` stay, but where lines of them are two cells wide, one is taken away in the end.
///
/// Source: distance-ordered homotopic thinning, Pudney, CVIU 72(3), 1998.
/// @param order indices of all cells of the set, the first to be removed first
void thin(const std::vector<std::size_t>& order, const CellMask& kept, CellMask* set);

}  // namespace cairn
