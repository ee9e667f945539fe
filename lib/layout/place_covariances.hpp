#pragma once

#include "layout/travel_residual.hpp"

namespace cairn {

/// The covariance of every place's (x, y, theta) in the global frame, by the inverse of the sum of
/// squares' curvature at a layout; place 0 is certain. Part of the place layout; not for other
/// layers.
/// Cost: one sparse factorisation, and three solutions for each place.
[[nodiscard]] std::vector<Matrix3d> place_covariances(const PlaceVector& places,
                                                      const std::vector<TravelResidual>& travels);

}  // namespace cairn
