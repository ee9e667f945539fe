#pragma once

#include <vector>

#include "layout/clique.hpp"

namespace cairn {

/// Places that must be linearised anew for the solution to be that of the travels: both ends of
/// those whose expansion is off where the places are now, and what would be off beside them when
/// they are. Part of the place layout; not for other layers.
///
/// Source: fluid relinearisation, Kaess et al., iSAM2, IJRR 2012, Alg. 5; with a threshold on what
/// the expansion neglects, in standard deviations, where they have one on the step.
/// @param steps by place, from where its travels were linearised
/// @param changed the places whose steps have changed
[[nodiscard]] std::vector<int> stale_places(const LinearisedTravels& travels,
                                            const PlaceVector& steps,
                                            const std::vector<int>& changed);

}  // namespace cairn
