#include "grid/thinning.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

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

/// Removes what may go of the cells in `order`, pass by pass until none goes. Leaves the cells that
/// stay in `order`.
void remove_all(bool keeps_ends, std::vector<std::uint32_t>* order, PaddedCells* set) {
  std::size_t before = order->size() + 1;
  while (order->size() < before) {
    before = order->size();
    std::size_t left = 0;
    for (const std::uint32_t at : *order) {
      const unsigned bits = set->neighbours_of(at);
      if (kIsSimple[bits] && !(keeps_ends && is_end(bits))) {
        set->remove(at);
      } else {
        (*order)[left++] = at;
      }
    }
    order->resize(left);
  }
}

}  // namespace

void thin(const PaddedCells& kept, std::vector<std::uint32_t>* order, PaddedCells* set) {
  std::vector<std::uint32_t> candidates;
  candidates.reserve(order->size());
  std::copy_if(order->begin(), order->end(), std::back_inserter(candidates),
               [&](std::uint32_t at) { return !kept.has(at); });
  remove_all(false, &candidates, set);
  order->erase(
      std::remove_if(order->begin(), order->end(), [&](std::uint32_t at) { return !set->has(at); }),
      order->end());
  remove_all(true, order, set);
}

}  // namespace cairn
