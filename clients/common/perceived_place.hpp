#pragma once

#include <string>
#include <vector>

#include <cairn_lcm/perceived_place_t.hpp>

namespace cairn::clients {

/// Throws Failure(kBadData) for a message whose numbers do not fit together.
void check_perceived_place(const cairn_lcm::perceived_place_t& place);

/// The opening on a picture: "0" of a gateway of the star; letters for others, in their order.
[[nodiscard]] std::string opening_label(const cairn_lcm::perceived_place_t& place, std::size_t i);

/// A point in the frame of a place.
struct PlacePoint {
  double x_m = 0.0;
  double y_m = 0.0;
};
/// A path fragment as a curve, in by its gateway and out by the other; where the path ends, a good
/// part of the way to the middle. Empty where its gateway is not among the openings.
/// @pre i < fragment_from.size()
[[nodiscard]] std::vector<PlacePoint> fragment_course(const cairn_lcm::perceived_place_t& place,
                                                      std::size_t i);

}  // namespace cairn::clients
