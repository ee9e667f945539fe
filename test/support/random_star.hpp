#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include "star/star.hpp"

namespace cairn::test {

/// A valid star of so many fragments, each with one or two gateways, crossing one another anyhow.
inline Star random_star(std::size_t fragments, std::mt19937& random) {
  std::vector<std::size_t> order(2 * fragments);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random() % i]);
  }
  Star star;
  star.slots.resize(order.size());
  for (std::size_t i = 0; i < order.size(); i += 2) {
    StarSlot& plus = star.slots[order[i]];
    StarSlot& minus = star.slots[order[i + 1]];
    plus = {0, order[i + 1], ControlLaw::kMidline};
    minus = {random() % 2 == 0 ? 0 : -1, order[i], ControlLaw::kNone};
  }
  int gateways = 0;
  for (StarSlot& slot : star.slots) {
    slot.gateway = slot.gateway < 0 ? -1 : gateways++;
  }
  return star;
}

/// A number in [0, count).
inline int random_below(int count, std::mt19937& random) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

}  // namespace cairn::test
