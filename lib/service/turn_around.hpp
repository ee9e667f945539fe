#pragma once

#include <optional>

#include "place/place_stay.hpp"

namespace cairn {

/// Whether a visit continues the one before it: the robot turned around on its way, where no place
/// is, and came back through the gateway by which it had left. That is no experience of another
/// place: nothing lies beyond that gateway yet but some way.
///
/// @param within_m two readings of one place lie less apart
/// @return the gateway by which the visit was left then, in the numbers of the visit before; -1
///     where the robot is still there. None where the visit is not such, or the visit before did
///     not see that gateway.
/// @pre both are told in the same frame lpm, which has not drifted noticeably between them
[[nodiscard]] std::optional<int> departure_after_turning_around(const PlaceVisit& before,
                                                                const PlaceVisit& visit,
                                                                double within_m);

}  // namespace cairn
