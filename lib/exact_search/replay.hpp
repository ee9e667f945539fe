#pragma once

#include <vector>

#include "exact_search/observed_walk.hpp"
#include "topology/topological_map.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// The map that a search reached, as a value: the changes that the steps of a walk made, in order.
/// Its visits keep the views of the walk.
/// @pre as many changes as steps at most; only kNothing, kPlace and kLink
[[nodiscard]] TopologicalMap replay(const ObservedWalk& walk,
                                    const std::vector<MapChange>& changes);

}  // namespace cairn
