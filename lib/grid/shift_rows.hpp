#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Moves what is held of the cells of a window along with the ground: what was of cell c is now of
/// cell c - moved, and `fill` of cells about which nothing was held.
template <typename Value>
void shift_rows(Cell moved, int width, int height, Value fill, std::vector<Value>* cells) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const auto row_at = [&](int y) { return cells->data() + std::ptrdiff_t{y} * width; };
  const int kept = std::max(0, width - std::abs(moved.x));
  const int to_x = kept > 0 ? std::max(0, -moved.x) : width;
  const int from_x = std::max(0, moved.x);
  for (int i = 0; i < height; ++i) {
    const int y = moved.y >= 0 ? i : height - 1 - i;
    const int from_y = y + moved.y;
    Value* const to = row_at(y);
    if (from_y < 0 || from_y >= height || kept == 0) {
      std::fill_n(to, width, fill);
      continue;
    }
    std::memmove(static_cast<void*>(to + to_x), row_at(from_y) + from_x,
                 static_cast<std::size_t>(kept) * sizeof(Value));
    std::fill_n(to, to_x, fill);
    std::fill_n(to + to_x + kept, width - kept - to_x, fill);
  }
}

}  // namespace cairn
