#pragma once

#include <cstddef>
#include <vector>

#include "star/star.hpp"

namespace cairn::test {

/// A star by its slots, clockwise: number of the gateway or -1, and slot of the partner.
inline Star star_of(const std::vector<int>& gateways, const std::vector<std::size_t>& partners) {
  Star star;
  for (std::size_t slot = 0; slot < gateways.size(); ++slot) {
    const ControlLaw law = gateways[slot] < 0 ? ControlLaw::kDeadEnd : ControlLaw::kMidline;
    star.slots.push_back({gateways[slot], partners.at(slot), law});
  }
  return star;
}

inline Star dead_end() {
  return star_of({0, -1}, {1, 0});
}
inline Star corridor() {
  return star_of({0, 1}, {1, 0});
}
/// Coming in by gateway 1 one turns right, by gateway 0 left.
inline Star corner() {
  return star_of({0, 1, -1, -1}, {2, 3, 0, 1});
}
/// Gateways 0 and 2 lie in line, 1 is the stem.
inline Star tee() {
  return star_of({0, 1, 2, -1}, {2, 3, 0, 1});
}
inline Star crossing() {
  return star_of({0, 1, 2, 3}, {2, 3, 0, 1});
}

}  // namespace cairn::test
