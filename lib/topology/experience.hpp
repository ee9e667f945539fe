#pragma once

#include <vector>

#include "star/star.hpp"
#include "topology/ids.hpp"
#include "topology/reading.hpp"

namespace cairn {

/// What the robot saw when it came to a place: the pair <tau, gw> of the view <LPM, tau, gw> in
/// Kuipers et al., ICRA 2004, Sec. III-D. The LPM stays with the visit and is matched by Evidence.
///
/// Where perception leaves the star open, the view carries several readings. `star` is the first
/// one; arrival and departure are always told in its numbers.
struct View {
  Star star;  ///< Of this visit; it need not begin at the same slot as an earlier one.
  int arrival_gateway = 0;  ///< The gateway of `star` through which the robot came in.
  VisitId visit;
  double log_likelihood = 0.0;       ///< Of the first reading, as Reading::log_likelihood.
  std::vector<Reading> others = {};  ///< The readings 1, 2, ...
};

/// Leave by a gateway and travel to the next place. Turns are not actions of their own, since the
/// star of a place tells all of them.
struct Action {
  int turn =
      0;  ///< Gateways clockwise from the one of arrival: 0 goes back where the robot came from.
};

/// Whether a view can be taken up: a valid star of at most kMostGateways that has the arrival
/// gateway, a valid visit, a log-likelihood that is finite and not positive, and at most
/// kMostReadings readings, each valid beside the first one.
Status validate(const View& view);

[[nodiscard]] int reading_count(const View& view);

/// @pre 0 <= reading < reading_count(view)
[[nodiscard]] const Star& star_of(const View& view, int reading);

/// In the numbers of that reading's star.
/// @pre view is valid, 0 <= reading < reading_count(view)
[[nodiscard]] int arrival_gateway_of(const View& view, int reading);

/// Whether it was not seen, but recalled from an earlier visit.
/// @pre 0 <= reading < reading_count(view)
[[nodiscard]] bool is_recalled(const View& view, int reading);

/// The number in the first reading of a gateway of this one; -1: the first reading lacks it.
/// @pre view is valid, 0 <= reading < reading_count(view), which has the gateway
[[nodiscard]] int gateway_of_first(const View& view, int reading, int gateway);

/// @pre 0 <= reading < reading_count(view)
[[nodiscard]] double log_likelihood_of(const View& view, int reading);

}  // namespace cairn
