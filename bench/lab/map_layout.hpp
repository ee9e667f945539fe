#pragma once

#include <vector>

#include "bench/lab/drawn_map.hpp"

namespace cairn::lab {

/// Where a place is drawn: x to the right, y down, links about 1 long.
struct DrawnPosition {
  double x = 0.0;
  double y = 0.0;
  double turned_rad = 0.0;  ///< Clockwise, of the place's slot 0 from "up".
};

/// The direction in which a gateway leaves, clockwise from "up": slots are spread evenly.
[[nodiscard]] double direction_rad(const DrawnPlace& place, double turned_rad, int gateway);

/// A drawing in which links leave their places as nearly as can be in the directions of their
/// gateways, so that streets come out straight and a grid as a grid, and places that are not near
/// in the map are kept apart.
///
/// Alternates between the best turn of each place and the best positions, as Sorkine and Alexa,
/// "As-rigid-as-possible surface modeling", SGP 2007, with the stress of Gansner et al., "Graph
/// drawing by stress majorization", GD 2004, as a weak second term.
[[nodiscard]] std::vector<DrawnPosition> laid_out(const DrawnMap& map);

}  // namespace cairn::lab
