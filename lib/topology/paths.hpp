#pragma once

#include <vector>

#include "topology/topological_map.hpp"

namespace cairn {

/// A place as a path passes it.
struct PathStop {
  PlaceId place;
  std::size_t forward_slot = 0;   ///< Slot of the place's star that points along the path.
  std::size_t backward_slot = 0;  ///< Its partner.
};

/// A maximal chain of path fragments joined by links, in the order of its places. Which of the two
/// directions is forward is arbitrary but reproducible.
struct Path {
  std::vector<PathStop> stops;
};

/// All paths; PathId is the position in the result. Cost: linear in the number of gateways.
[[nodiscard]] std::vector<Path> trace_paths(const TopologicalMap& map);

/// The places on the path that ends at a pending gateway, beginning with the gateway's own.
/// @pre end is pending
[[nodiscard]] std::vector<PlaceId> places_behind(const TopologicalMap& map, GatewayRef end);

/// Whether linking the two would put a place twice on a path: against the axiom that the order of
/// places on a path is irreflexive, which excludes self-loops, circular paths and paths that cross
/// themselves.
/// @pre both are pending
[[nodiscard]] bool would_repeat_a_place(const TopologicalMap& map, GatewayRef a, GatewayRef b);

}  // namespace cairn
