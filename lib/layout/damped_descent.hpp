#pragma once

#include "layout/travel_residual.hpp"

namespace cairn {

/// Moves the places to the nearest least sum of squares by Ceres' Levenberg-Marquardt steps: for
/// where Gauss-Newton steps do not descend. Place 0 is held. Part of the place layout; not for
/// other layers.
/// @return the number of steps; kNotConverged with what Ceres says
[[nodiscard]] Result<int> descend_damped(const std::vector<TravelResidual>& travels,
                                         const LayoutOptions& options,
                                         PlaceVector* places);

}  // namespace cairn
