#pragma once

#include <vector>

#include "place/gateway.hpp"
#include "place/path_fragments.hpp"
#include "place/place_options.hpp"
#include "star/star.hpp"

namespace cairn {

/// An opening that may be a gateway: too little was seen behind it.
struct UnsureGateway {
  Gateway gateway;
  double log_odds = 0.0;    ///< ln p(passage) - ln p(no passage).
  bool is_doorway = false;  ///< Narrow: its door may be closed next time.
};

/// Another star that the same place may have.
struct StarReading {
  Star star;
  /// For each gateway of `star` its number in the first reading's star; -1 where that lacks it.
  std::vector<int> gateways;
  double log_likelihood = 0.0;  ///< Less than that of the first reading, nats.
  friend bool operator==(const StarReading&, const StarReading&) = default;
};

/// All stars that a place may have, the likeliest one first.
struct StarReadings {
  std::vector<Gateway> gateways;  ///< Of the first reading, clockwise.
  std::vector<PathFragment> fragments;
  Star star;
  std::vector<StarReading> others;  ///< The likeliest first.
};

/// Reads the star of a place, with and without the gateways that are least sure, at most two; of
/// others that are unsure the likelier alternative is taken.
/// @param gateways what is sure
[[nodiscard]] StarReadings read_stars(const Vector2d& center,
                                      const std::vector<Gateway>& gateways,
                                      const std::vector<UnsureGateway>& unsure,
                                      const PlaceOptions& options);

}  // namespace cairn
