#pragma once

#include <optional>
#include <vector>

#include "place/axis_sites.hpp"
#include "place/gateway.hpp"
#include "place/local_view.hpp"

namespace cairn {

/// What a way that leaves a site turns out to be.
struct WayOut {
  std::optional<Gateway> gateway;  ///< In the frame of the map.
  /// Whether the way ends in unknown space before it can be told: the place is not complete.
  bool is_undecided = false;
};

/// Looks for the gateway on a way: its first constriction, with passage beyond it. A way that ends
/// at walls soon is an alcove and no gateway. What lies beyond counts as passage as far as it was
/// seen free.
[[nodiscard]] WayOut way_out(const LocalView& view, AxisWay way, const PlaceOptions& options);

/// The gateways of a site in clockwise order around `center`. Of two that cannot be told apart by
/// their bearing the narrower is left out. `is_decided` becomes false where a way is undecided.
[[nodiscard]] std::vector<Gateway> gateways_of(const LocalView& view,
                                               const AxisSite& site,
                                               const Vector2d& center,
                                               const PlaceOptions& options,
                                               bool* is_decided);

}  // namespace cairn
