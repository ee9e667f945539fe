#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "star/star.hpp"

namespace cairn {

/// Bounds of what a view may hold; a view beyond them is refused.
constexpr std::size_t kMostReadings = 8;  ///< Of one view, the first included.
constexpr int kMostGateways = 64;         ///< Of the star of each reading.

/// Another star that one visit may be read as: the perception of a place may leave open whether a
/// constriction is a gateway, or which gateways one fragment joins.
struct Reading {
  Star star;
  /// For each gateway of `star`, its number in the star of the view's first reading; -1 where the
  /// first reading lacks it. They keep the clockwise order.
  std::vector<int> gateways;
  double log_likelihood =
      0.0;  ///< Of what was perceived, given that the place has this star (nats).
  /// Not seen, but recalled from an earlier visit: says how a place that is known already may have
  /// looked this time. No new place has such a star.
  bool is_recalled = false;
};

/// The gateway of the reading that is this one of the first reading, if it has it.
[[nodiscard]] std::optional<int> gateway_in(const Reading& reading, int gateway_of_first);

/// Whether it can be a reading beside a first one of so many gateways, entered by this one: a valid
/// star of at most kMostGateways; each gateway at most once that of the first reading, clockwise,
/// the one of arrival among them; a log-likelihood that is finite and not positive.
/// @pre 0 <= arrival_gateway < first_gateway_count
Status validate(const Reading& reading, int first_gateway_count, int arrival_gateway);

/// Whether a star can be that of a reading: valid and of at most kMostGateways.
Status validate_read_star(const Star& star);

/// Whether it is finite and at most 0, as that of a reading must be.
Status validate_log_likelihood(double log_likelihood);

}  // namespace cairn
