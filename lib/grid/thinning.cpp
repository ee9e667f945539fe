#include "grid/thinning.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace cairn {
namespace {

/// A set with an empty cell all around, so that every cell of it has eight neighbours.
class PaddedSet {
 public:
  explicit PaddedSet(const CellMask& set)
      : set_width_(static_cast<std::uint32_t>(set.width)),
        width_(std::size_t{set_width_} + 2),
        cells_(width_ * (static_cast<std::size_t>(set.height) + 2)) {
    for (std::size_t row = 0; row < static_cast<std::size_t>(set.height); ++row) {
      std::copy_n(set.cells.data() + row * set_width_, set_width_,
                  cells_.data() + (row + 1) * width_ + 1);
    }
  }

  void write(CellMask* set) const {
    for (std::size_t row = 0; row < static_cast<std::size_t>(set->height); ++row) {
      std::copy_n(cells_.data() + (row + 1) * width_ + 1, set_width_,
                  set->cells.data() + row * set_width_);
    }
  }

  [[nodiscard]] std::size_t padded(std::size_t index) const {
    // Divides in 32 bits, which is much faster; a mask of more cells fits into no memory.
    const std::uint32_t row = static_cast<std::uint32_t>(index) / set_width_;
    return index + width_ + 1 + 2 * std::size_t{row};
  }
  [[nodiscard]] bool has(std::size_t at) const { return cells_[at] != 0; }
  void remove(std::size_t at) { cells_[at] = 0; }

  /// The eight neighbours of a cell as bits, counterclockwise from the east.
  [[nodiscard]] unsigned neighbours_of(std::size_t at) const {
    const std::uint8_t* const own = cells_.data() + at;
    const std::uint8_t* const above = own + width_;
    const std::uint8_t* const below = own - width_;
    return unsigned{own[1]} | unsigned{above[1]} << 1U | unsigned{above[0]} << 2U |
           unsigned{above[-1]} << 3U | unsigned{own[-1]} << 4U | unsigned{below[-1]} << 5U |
           unsigned{below[0]} << 6U | unsigned{below[1]} << 7U;
  }

 private:
  std::uint32_t set_width_;
  std::size_t width_;
  std::vector<std::uint8_t> cells_;
};

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
void remove_all(bool keeps_ends, std::vector<std::size_t>* order, PaddedSet* set) {
  std::size_t before = order->size() + 1;
  while (order->size() < before) {
    before = order->size();
    std::size_t left = 0;
    for (const std::size_t at : *order) {
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

void thin(const std::vector<std::size_t>& order, const CellMask& kept, CellMask* set) {
  PaddedSet padded(*set);
  std::vector<std::size_t> all;
  std::vector<std::size_t> candidates;
  all.reserve(order.size());
  candidates.reserve(order.size());
  for (const std::size_t index : order) {
    if (set->cells[index] != 0) {
      all.push_back(padded.padded(index));
      if (kept.cells[index] == 0) {
        candidates.push_back(all.back());
      }
    }
  }
  remove_all(false, &candidates, &padded);
  all.erase(std::remove_if(all.begin(), all.end(), [&](std::size_t at) { return !padded.has(at); }),
            all.end());
  remove_all(true, &all, &padded);
  padded.write(set);
}

}  // namespace cairn
