#include "grid/thinning.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "grid/shift_rows.hpp"

namespace cairn {
namespace {

/// The crossing number of Hilditch: how many 8-connected pieces the neighbours fall into as seen
/// from the cell, when gaps of the complement count by their 4-neighbours.
constexpr int crossing_number(unsigned bits) {
  int crossings = 0;
  for (unsigned i = 0; i < 8; i += 2) {
    const bool side_empty = (bits >> i & 1U) == 0;
    const bool corner = (bits >> (i + 1) & 1U) != 0;
    const bool next_side = (bits >> ((i + 2) % 8) & 1U) != 0;
    crossings += side_empty && (corner || next_side) ? 1 : 0;
  }
  return crossings;
}

/// For all neighbourhoods: whether the cell can be taken away without any change of topology.
constexpr std::array<bool, 256> kIsSimple = [] {
  std::array<bool, 256> is_simple{};
  for (unsigned bits = 0; bits < is_simple.size(); ++bits) {
    is_simple[bits] = crossing_number(bits) == 1;
  }
  return is_simple;
}();

/// Whether a line would lose length with the cell: its end, or the end of a line two cells wide.
/// The corner of a stair, between two sides, would not be missed.
bool is_end(unsigned bits) {
  constexpr unsigned kSides = 1U | 4U | 16U | 64U;
  const int count = std::popcount(bits);
  return count < 2 || (count == 2 && (bits & ~kSides) != 0);
}

}  // namespace

bool is_simple(unsigned neighbours) {
  return kIsSimple[neighbours];
}

void PaddedCells::shift(Cell moved) {
  const std::size_t height = cells_.size() / width_;
  shift_rows<std::uint8_t>(moved, static_cast<int>(width_), static_cast<int>(height), 0, &cells_);
  std::fill_n(cells_.begin(), width_, std::uint8_t{0});
  std::fill_n(cells_.end() - static_cast<std::ptrdiff_t>(width_), width_, std::uint8_t{0});
  for (std::size_t row = 0; row < cells_.size(); row += width_) {
    cells_[row] = 0;
    cells_[row + width_ - 1] = 0;
  }
}

void thin_lines(std::vector<std::uint32_t>* order, PaddedCells* set) {
  std::size_t before = order->size() + 1;
  while (order->size() < before) {
    before = order->size();
    std::size_t left = 0;
    for (const std::uint32_t at : *order) {
      const unsigned bits = set->neighbours_of(at);
      if (kIsSimple[bits] && !is_end(bits)) {
        set->remove(at);
      } else {
        (*order)[left++] = at;
      }
    }
    order->resize(left);
  }
}

}  // namespace cairn
