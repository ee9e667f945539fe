#pragma once

#include "exact_search/map_counts.hpp"
#include "topology/topological_map.hpp"

namespace cairn {

/// What a map says of the order of places on its paths.
struct OrderAtoms {
  int paths_with_two_places = 0;  ///< Or more: the others have no order.
  std::int64_t count = 0;         ///< Pairs of places of which a path says which comes first.
};
[[nodiscard]] OrderAtoms order_atoms(const TopologicalMap& map);

/// Counts one of the simplest maps among those of the fewest order atoms.
void count_order_atoms(const TopologicalMap& map, MinimalRegionMaps* maps);

}  // namespace cairn
