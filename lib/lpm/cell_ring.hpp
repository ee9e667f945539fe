#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// The cells of a window that moves by whole cells, without moving what it holds: the rows lie in
/// one ring of memory, one after the other, and only its beginning moves. What comes in is filled
/// anew.
template <typename T>
class CellRing {
 public:
  CellRing(int width, int height, T fill)
      : width_(width),
        height_(height),
        fill_(fill),
        cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  /// @pre the cell lies within the window
  [[nodiscard]] const T& operator[](Cell c) const { return cells_[index_of(c)]; }
  [[nodiscard]] T& operator[](Cell c) { return cells_[index_of(c)]; }

  /// So many cells from `c` on along its row lie side by side in memory, `count` at most.
  /// @pre they lie within the window
  [[nodiscard]] int run_length(Cell c, int count) const {
    return static_cast<int>(std::min(static_cast<std::size_t>(count), cells_.size() - index_of(c)));
  }

  /// Moves the window: the cell at `c` is at `c - by` then.
  void shift(Cell by) {
    if (std::abs(by.x) >= width_ || std::abs(by.y) >= height_) {
      clear();
      return;
    }
    const auto size = static_cast<std::ptrdiff_t>(cells_.size());
    const std::ptrdiff_t moved =
        static_cast<std::ptrdiff_t>(begin_) + static_cast<std::ptrdiff_t>(by.y) * width_ + by.x;
    begin_ = static_cast<std::size_t>((moved + size) % size);
    fill({by.x > 0 ? width_ - by.x : 0, 0}, {by.x > 0 ? width_ : -by.x, height_});
    fill({0, by.y > 0 ? height_ - by.y : 0}, {width_, by.y > 0 ? height_ : -by.y});
  }

  void clear() { std::fill(cells_.begin(), cells_.end(), fill_); }

  /// Fills the cells from `low` up to, and without, those of `end`.
  /// @pre they lie within the window
  void fill(Cell low, Cell end) {
    for (int y = low.y; y < end.y; ++y) {
      for (int x = low.x; x < end.x;) {
        const int run = run_length({x, y}, end.x - x);
        std::fill_n(&cells_[index_of({x, y})], run, fill_);
        x += run;
      }
    }
  }

  [[nodiscard]] std::size_t memory_bytes() const { return cells_.capacity() * sizeof(T); }

 private:
  [[nodiscard]] std::size_t index_of(Cell c) const {
    const std::size_t index = begin_ +
                              static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(c.x);
    return index < cells_.size() ? index : index - cells_.size();
  }

  int width_;
  int height_;
  T fill_;
  std::size_t begin_ = 0;  // of cell (0, 0)
  std::vector<T> cells_;
};

}  // namespace cairn
