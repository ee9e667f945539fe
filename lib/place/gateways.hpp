#pragma once

#include <optional>
#include <vector>

#include "place/axis_sites.hpp"
#include "place/gateway.hpp"
#include "place/local_view.hpp"
#include "place/opening.hpp"
#include "place/passage.hpp"
#include "place/star_readings.hpp"

namespace cairn {

/// What a way that leaves a site turns out to be. Neither: an alcove, which belongs to the place.
struct WayOut {
  std::optional<Gateway> gateway;       ///< In the frame of the map.
  std::optional<UnsureGateway> unsure;  ///< An opening behind which too little was seen.
  /// A doorway behind which next to nothing was seen: it bounds the place as a wall does.
  std::optional<Gateway> closed;
  /// Whether the way ends in unknown space before it can be told: the place is not complete.
  bool is_undecided = false;
  ConsideredOpening considered;  ///< The same with the figures that decided.
};

/// How far walls must be seen along the way behind an opening so wide for it to be a passage.
[[nodiscard]] double passage_depth_m(double width_m, const PlaceOptions& options);

/// Looks for the gateway on a way: its first constriction, with passage beyond it, between walls
/// for some depth; or through which the robot has gone. A way that ends at walls soon is an alcove
/// and no gateway.
[[nodiscard]] WayOut way_out(const LocalView& view,
                             const WalledLengths& walled,
                             const AxisSite& site,
                             AxisWay way,
                             const PlaceOptions& options);

/// All that bounds a site, apart from walls.
struct SiteBounds {
  std::vector<Gateway> gateways;  ///< Clockwise.
  std::vector<UnsureGateway> unsure;
  std::vector<Gateway> closed;
  bool is_decided = true;
  std::vector<ConsideredOpening> considered;  ///< Every way out, with what became of it.
};

/// Looks at all ways out of a site. Of two gateways that cannot be told apart by their bearing from
/// the centre the unsure, or the narrower, counts as closed.
[[nodiscard]] SiteBounds bounds_of(const LocalView& view,
                                   const WalledLengths& walled,
                                   const AxisSite& site,
                                   const Vector2d& center,
                                   const PlaceOptions& options);

}  // namespace cairn
