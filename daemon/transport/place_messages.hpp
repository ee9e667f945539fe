#pragma once

#include <cstdint>

#include <cairn_lcm/perceived_place_t.hpp>

#include "place/place_options.hpp"
#include "place/place_stay.hpp"

namespace cairn {

/// What was seen of a place at a visit, as clients draw it. Its place is not known here: -1.
/// @param visit its number
/// @param options of the detector that saw it
[[nodiscard]] cairn_lcm::perceived_place_t to_perceived_place(const PlaceVisit& perceived,
                                                              std::int64_t visit,
                                                              const PlaceOptions& options);

}  // namespace cairn
