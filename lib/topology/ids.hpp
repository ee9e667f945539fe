#pragma once

#include <compare>

#include "base/id.hpp"

namespace cairn {

using PlaceId = Id<struct PlaceTag>;            ///< A place of one map: 0, 1, ... as they were met.
using PathId = Id<struct PathTag>;              ///< A path of one map, as trace_paths() lists them.
using VisitId = Id<struct VisitTag>;            ///< An arrival in the experience: 0 is the start.
using HypothesisId = Id<struct HypothesisTag>;  ///< A node of the tree; never given twice.

/// A gateway of a place, numbered clockwise as in the place's star.
struct GatewayRef {
  PlaceId place;
  int gateway = 0;
  friend auto operator<=>(const GatewayRef&, const GatewayRef&) = default;
};

}  // namespace cairn
