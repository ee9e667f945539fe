#pragma once

#include <vector>

#include "place/opening.hpp"
#include "place/place_options.hpp"
#include "place/place_stay.hpp"

namespace cairn {

/// An opening and its number in the star; -1 where the star does not have it.
struct NumberedOpening {
  ConsideredOpening opening;
  int gateway = -1;
};

/// What was seen of a place at one visit, for a person to see, too. Frame place.
struct PlacePerception {
  StateGrid looked_at;  ///< The stored map as it is looked at: coarse, without specks.
  std::vector<std::vector<Vector2d>> axis;  ///< Its medial axis, edge by edge, as polylines.
  std::vector<NumberedOpening> openings;    ///< Gateways in the order of the star, then the others.
};

/// Looks at the stored map of a visit once more, for its medial axis; all else is as it was judged
/// during the visit. Of a visit from the journal, which does not keep what was considered, only
/// gateways are given.
[[nodiscard]] PlacePerception perceive(const PlaceVisit& visit, const PlaceOptions& options);

}  // namespace cairn
