#pragma once

#include "topology/topological_map.hpp"

namespace cairn {

/// Whether every path has a left and a right: for each path A and each place on it, the other
/// fragments of the place are followed outward; what they meet lies right of A if they leave
/// clockwise between A's forward and A's backward slot, else left. No place may then lie on both
/// sides of A, and none of A's own places on either. Terminated ends take part in the circular
/// order.
///
/// Boundary regions of Kuipers et al., ICRA 2004; only direct crossings count, the relation is not
/// propagated further. A violation never heals as a map grows. New places cannot violate it.
/// Cost: the sum over paths of the lengths of the paths that cross them.
[[nodiscard]] bool is_region_consistent(const TopologicalMap& map);

/// Whether two paths share two places.
[[nodiscard]] bool has_double_meeting(const TopologicalMap& map);

/// Whether three paths meet pairwise, but not all at one place.
[[nodiscard]] bool has_triangle(const TopologicalMap& map);

/// "Qualitatively perpendicular" (Savelli and Kuipers, IROS 2004, Sec. IV): no two paths meet twice
/// and no three form a triangle.
[[nodiscard]] bool is_perpendicular(const TopologicalMap& map);

}  // namespace cairn
