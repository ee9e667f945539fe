#include "lpm/square_maxima.hpp"

#include <algorithm>

namespace cairn {
namespace {

/// Two squares that overlap or touch make one that is wider by a shift: the greater of the value
/// here and of that a shift farther on, along a row or from row to row. What is farther on than
/// the end is nothing.
void take_farther(const std::uint8_t* from,
                  std::size_t count,
                  std::size_t shift,
                  std::uint8_t* to) {
  const std::size_t reached = count > shift ? count - shift : 0;
  for (std::size_t i = 0; i < reached; ++i) {
    to[i] = std::max(from[i], from[i + shift]);
  }
  std::copy(from + reached, from + count, to + reached);
}

}  // namespace

int SquareMaxima::kind_for(int side_cells) {
  return static_cast<int>(std::lower_bound(kSides_cells.begin(), kSides_cells.end(), side_cells) -
                          kSides_cells.begin());
}

SquareMaxima::SquareMaxima(const GridGeometry& geometry)
    : width_(geometry.width),
      height_(geometry.height),
      stride_(geometry.width + kWidest_cells + 1),
      plane_(stride_ * (geometry.height + kWidest_cells + 1)) {
  const auto plane = static_cast<std::size_t>(plane_);
  values_ = std::make_unique_for_overwrite<std::uint8_t[]>(kSides_cells.size() * plane);
  std::fill_n(values_.get(), plane, std::uint8_t{0});
}

SquareMaxima::SquareMaxima(const GridGeometry& geometry, const std::vector<std::uint8_t>& values)
    : SquareMaxima(geometry) {
  for (int y = 0; y < height_; ++y) {
    const auto first = static_cast<std::ptrdiff_t>(geometry.index_of({0, y}));
    std::copy_n(values.begin() + first, width_, row(y));
  }
  for (int kind = 1; kind < static_cast<int>(kSides_cells.size()); ++kind) {
    widen(kind);
  }
}

void SquareMaxima::widen(int kind) {
  const auto here = static_cast<std::size_t>(kind);
  std::size_t below = here - 1;  // the smallest that is at least half as wide
  while (below > 0 && 2 * kSides_cells[below - 1] >= kSides_cells[here]) {
    --below;
  }
  const auto shift = static_cast<std::size_t>(kSides_cells[here] - kSides_cells[below]);
  const auto row = static_cast<std::size_t>(stride_);
  const auto plane = static_cast<std::size_t>(plane_);
  std::vector<std::uint8_t> longer(plane);
  for (std::size_t first = 0; first < plane; first += row) {
    take_farther(&values_[below * plane + first], row, shift, &longer[first]);
  }
  take_farther(longer.data(), plane, shift * row, &values_[here * plane]);
}

Cell SquareMaxima::inside(Cell cell) const {
  return {std::clamp(cell.x, -kWidest_cells, width_), std::clamp(cell.y, -kWidest_cells, height_)};
}

}  // namespace cairn
