#include "grid/thinning.hpp"

#include <bit>

namespace cairn {
namespace {

/// The eight neighbours of a cell as bits, counterclockwise from the east.
unsigned neighbours_of(const CellMask& set, int x, int y) {
  unsigned bits = 0;
  bits |= set.has(x + 1, y) ? 1U : 0U;
  bits |= set.has(x + 1, y + 1) ? 2U : 0U;
  bits |= set.has(x, y + 1) ? 4U : 0U;
  bits |= set.has(x - 1, y + 1) ? 8U : 0U;
  bits |= set.has(x - 1, y) ? 16U : 0U;
  bits |= set.has(x - 1, y - 1) ? 32U : 0U;
  bits |= set.has(x, y - 1) ? 64U : 0U;
  bits |= set.has(x + 1, y - 1) ? 128U : 0U;
  return bits;
}

/// The crossing number of Hilditch: how many 8-connected pieces the neighbours fall into as seen
/// from the cell, when gaps of the complement count by their 4-neighbours.
int crossing_number(unsigned bits) {
  int crossings = 0;
  for (unsigned i = 0; i < 8; i += 2) {
    const bool side_empty = (bits >> i & 1U) == 0;
    const bool corner = (bits >> (i + 1) & 1U) != 0;
    const bool next_side = (bits >> ((i + 2) % 8) & 1U) != 0;
    crossings += side_empty && (corner || next_side) ? 1 : 0;
  }
  return crossings;
}

/// Whether a cell can be taken away without any change of topology.
bool is_simple(unsigned bits) {
  return crossing_number(bits) == 1;
}

/// Whether a line would lose length with the cell: its end, or the end of a line two cells wide.
/// The corner of a stair, between two sides, would not be missed.
bool is_end(unsigned bits) {
  constexpr unsigned kSides = 1U | 4U | 16U | 64U;
  const int count = std::popcount(bits);
  return count < 2 || (count == 2 && (bits & ~kSides) != 0);
}

bool remove_once(const std::vector<std::size_t>& order, const CellMask* kept, CellMask* set) {
  bool changed = false;
  for (const std::size_t index : order) {
    if (set->cells[index] == 0 || (kept != nullptr && kept->cells[index] != 0)) {
      continue;
    }
    const int x = static_cast<int>(index % static_cast<std::size_t>(set->width));
    const int y = static_cast<int>(index / static_cast<std::size_t>(set->width));
    const unsigned bits = neighbours_of(*set, x, y);
    if (is_simple(bits) && (kept != nullptr || !is_end(bits))) {
      set->cells[index] = 0;
      changed = true;
    }
  }
  return changed;
}

}  // namespace

void thin(const std::vector<std::size_t>& order, const CellMask& kept, CellMask* set) {
  while (remove_once(order, &kept, set)) {
  }
  while (remove_once(order, nullptr, set)) {
  }
}

}  // namespace cairn
