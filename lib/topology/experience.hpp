#pragma once

#include "star/star.hpp"
#include "topology/ids.hpp"

namespace cairn {

/// What the robot saw when it came to a place: the pair <tau, gw> of the view <LPM, tau, gw> in
/// Kuipers et al., ICRA 2004, Sec. III-D. The LPM stays with the visit and is matched by Evidence.
struct View {
  Star star;  ///< Of this visit; it need not begin at the same slot as an earlier one.
  int arrival_gateway = 0;  ///< The gateway of `star` through which the robot came in.
  VisitId visit;
};

/// Leave by a gateway and travel to the next place. Turns are not actions of their own, since the
/// star of a place tells all of them.
struct Action {
  int turn =
      0;  ///< Gateways clockwise from the one of arrival: 0 goes back where the robot came from.
};

/// Whether a view can be taken up: a valid star that has the arrival gateway, and a valid visit.
Status validate(const View& view);

}  // namespace cairn
