#include "lpm/max_pyramid.hpp"

#include <algorithm>

namespace cairn {
namespace {

/// Maxima over squares twice as wide, each beginning at its cell, from those half as wide.
void widen(const std::vector<std::uint8_t>& below,
           const GridGeometry& geometry,
           int half,
           std::vector<std::uint8_t>* here) {
  here->resize(below.size());
  for (int y = 0; y < geometry.height; ++y) {
    const int upper_y = std::min(y + half, geometry.height - 1);
    const std::uint8_t* const lower = below.data() + geometry.index_of({0, y});
    const std::uint8_t* const upper = below.data() + geometry.index_of({0, upper_y});
    std::uint8_t* const row = here->data() + geometry.index_of({0, y});
    for (int x = 0; x < geometry.width; ++x) {
      const int right = std::min(x + half, geometry.width - 1);
      row[x] = std::max({lower[x], lower[right], upper[x], upper[right]});
    }
  }
}

}  // namespace

void CellOffsets::add(Cell cell, int map_width) {
  low = cells.empty() ? cell : Cell{std::min(low.x, cell.x), std::min(low.y, cell.y)};
  high = cells.empty() ? cell : Cell{std::max(high.x, cell.x), std::max(high.y, cell.y)};
  cells.push_back(cell);
  indices.push_back(cell.y * map_width + cell.x);
}

MaxPyramid::MaxPyramid(const GridGeometry& geometry, std::vector<std::uint8_t> values, int levels)
    : geometry_(geometry), levels_(static_cast<std::size_t>(levels)) {
  levels_[0] = std::move(values);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    widen(levels_[level - 1], geometry, 1 << (level - 1), &levels_[level]);
  }
}

std::int32_t MaxPyramid::greatest_sum(const CellOffsets& offsets, Cell low, int level) const {
  const std::vector<std::uint8_t>& values = levels_[static_cast<std::size_t>(level)];
  std::int32_t sum = 0;
  if (geometry_.contains({low.x + offsets.low.x, low.y + offsets.low.y}) &&
      geometry_.contains({low.x + offsets.high.x, low.y + offsets.high.y})) {
    const auto first = static_cast<std::ptrdiff_t>(geometry_.index_of(low));
    const std::uint8_t* const from = values.data() + first;
    for (const std::int32_t index : offsets.indices) {
      sum += from[index];
    }
    return sum;
  }
  const int size = 1 << level;
  for (const Cell& offset : offsets.cells) {
    const int x = low.x + offset.x;
    const int y = low.y + offset.y;
    if (x > -size && y > -size && x < geometry_.width && y < geometry_.height) {
      // A square that begins left of or below the map is bounded by the one at its border.
      sum += values[geometry_.index_of({std::max(x, 0), std::max(y, 0)})];
    }
  }
  return sum;
}

}  // namespace cairn
