#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "grid/medial_axis.hpp"

namespace cairn {

/// A constriction: a point of the medial axis where clearance is a local minimum near a larger
/// maximum. The critical line joins its two basis points.
struct CriticalPoint {
  std::size_t edge = 0;      ///< Of the axis.
  std::size_t position = 0;  ///< Of its cells.
  Cell cell;
  double clearance_m = 0.0;
  std::array<Cell, 2>
      basis_points;  ///< Nearest cells that are not free, on either side of the axis.
};

struct CriticalPointOptions {
  double near_m = 2.0;   ///< How far along the axis the larger maximum may be. > 0
  double drop_m = 0.15;  ///< By how much it must be larger. > 0
};

[[nodiscard]] Status validate(const CriticalPointOptions& options);

/// The basis points of a point of an edge, one on each side: the nearest cells that are not free to
/// the left and to the right of the edge's direction there. Right comes first, so that someone who
/// travels from the edge's `from` to its `to` has it on the right hand.
[[nodiscard]] std::array<Cell, 2> basis_points_at(const DistanceTransform& distances,
                                                  const AxisEdge& edge,
                                                  std::size_t position);

/// All critical points of the axis, in the order of edges and of positions along them.
///
/// Source: Thrun and Bücken, AAAI 1996, "Topological Maps", step 3; Kuipers et al., ICRA 2004,
/// Sec. III-B and Fig. 3(b, c).
[[nodiscard]] std::vector<CriticalPoint> critical_points(const DistanceTransform& distances,
                                                         const MedialAxis& axis,
                                                         const CriticalPointOptions& options);

}  // namespace cairn
