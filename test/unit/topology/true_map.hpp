#pragma once

#include <set>
#include <utility>

#include "support/lattice.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn::test {

/// Whether the map puts visits at one place exactly where they were, and has as many places.
inline bool is_true_map(const TopologicalMap& map, const Walk& walk) {
  std::set<std::pair<int, int>> pairs;
  std::set<int> true_places;
  for (std::size_t visit = 0; visit < static_cast<std::size_t>(map.visit_count()); ++visit) {
    const PlaceId place = map.at_visit({static_cast<std::int32_t>(visit)}).place;
    pairs.insert({walk.truth[visit].first, place.value});
    true_places.insert(walk.truth[visit].first);
  }
  return pairs.size() == true_places.size() &&
         map.place_count() == static_cast<int>(true_places.size());
}

inline int count_true_maps(const HypothesisTree& tree, const Walk& walk) {
  int count = 0;
  tree.for_each_map([&](const Hypothesis&, const TopologicalMap& map) {
    count += is_true_map(map, walk) ? 1 : 0;
  });
  return count;
}

}  // namespace cairn::test
