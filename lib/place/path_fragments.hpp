#pragma once

#include <vector>

#include "place/gateway.hpp"

namespace cairn {

/// A part of a large-scale path that is grounded in the neighbourhood of one place.
struct PathFragment {
  int gateway = -1;  ///< Through which its + direction leaves.
  int through = -1;  ///< Through which its - direction leaves; -1 where it terminates at the place.
  /// Of a terminated end: the straight way inward is blocked by a wall, rather than that there is
  /// no clear default continuation.
  bool is_dead_end = true;
  friend bool operator==(const PathFragment&, const PathFragment&) = default;
};

struct ContinuationOptions {
  double max_turn_rad = 0.7;       ///< Between inbound and outbound heading. (0, pi)
  double rival_margin_rad = 0.26;  ///< Least extra turn of the next best continuation. >= 0
};

/// Decides which gateways a path passes through. Any rule that gives consistent decisions will do
/// (Kuipers et al., ICRA 2004, Sec. III-B): every gateway must be in exactly one fragment.
using ContinuationRule = std::vector<PathFragment> (*)(const std::vector<Gateway>& gateways,
                                                       const ContinuationOptions& options);

/// Two gateways belong to one path when, after arrival at one in the inbound direction, the clear
/// unique default travel continuation is the other in the outbound direction, and the other way
/// round. Clear: on the straight way from one gateway to the other the robot turns by less than
/// `max_turn_rad`, when it sets out, when it arrives, and in all; so what is offset sideways is no
/// continuation. Unique: no other gateway would ask for a similar turn. Nothing but directions is
/// compared, as these repeat from visit to visit better than lengths.
///
/// Gateways in clockwise order; fragments come in the order of their first gateway.
[[nodiscard]] std::vector<PathFragment> mutual_straight_continuations(
    const std::vector<Gateway>& gateways, const ContinuationOptions& options);

}  // namespace cairn
