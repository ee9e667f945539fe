#pragma once

#include <vector>

#include "topology/topological_map.hpp"

namespace cairn {

/// The pending gateways that open into the same face as this one, as a walk around the face meets
/// them; the gateway itself is left out. Unexplained gateways are passed by.
///
/// Source: face tracking with pending gateways, Savelli and Kuipers, IROS 2004, Sec. III.
/// @pre gateway is pending
/// Cost: the length of the face.
[[nodiscard]] std::vector<GatewayRef> pending_on_face(const TopologicalMap& map,
                                                      GatewayRef gateway);

/// Whether linking the two keeps a planar map planar: they open into the same face, or belong to
/// parts of the map that no link connects. Constraint (2c) of Fig. 2 of Savelli and Kuipers.
/// @pre both are pending
[[nodiscard]] bool can_link_in_plane(const TopologicalMap& map, GatewayRef a, GatewayRef b);

/// The least number of handles a surface needs for the map to be drawn on it without crossings, by
/// the formula of Euler and Poincaré: (|E| + 2 components - |V| - faces) / 2. 0 for the plane.
[[nodiscard]] int genus(const TopologicalMap& map);

}  // namespace cairn
