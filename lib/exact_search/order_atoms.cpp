#include "exact_search/order_atoms.hpp"

#include <algorithm>

#include "topology/paths.hpp"

namespace cairn {

OrderAtoms order_atoms(const TopologicalMap& map) {
  OrderAtoms atoms;
  for (const Path& path : trace_paths(map)) {
    const auto places = static_cast<std::int64_t>(path.stops.size());
    atoms.paths_with_two_places += places > 1 ? 1 : 0;
    atoms.count += places * (places - 1) / 2;
  }
  return atoms;
}

void count_order_atoms(const TopologicalMap& map, MinimalRegionMaps* maps) {
  const OrderAtoms atoms = order_atoms(map);
  const bool is_first = maps->count_fewest_order_atoms == 0;
  maps->paths_with_two_places =
      is_first ? atoms.paths_with_two_places
               : std::min(maps->paths_with_two_places, atoms.paths_with_two_places);
  if (is_first || atoms.count < maps->order_atoms) {
    maps->order_atoms = atoms.count;
    maps->count_fewest_order_atoms = 0;
  }
  maps->count_fewest_order_atoms += atoms.count == maps->order_atoms ? 1 : 0;
}

}  // namespace cairn
