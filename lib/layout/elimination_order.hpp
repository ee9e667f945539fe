#pragma once

#include <vector>

#include "layout/place_layout.hpp"

namespace cairn {

/// Numbers the places anew so that the sparse factorisations of the place layout stay sparse
/// without an ordering of their own. Place 0 stays place 0. Part of the place layout; not for other
/// layers.
///
/// Source: approximate minimum degree of Amestoy, Davis and Duff, 1996, on the graph of places.
/// @return by place its new number
[[nodiscard]] std::vector<int> elimination_order(int place_count,
                                                 const std::vector<TravelConstraint>& travels);

}  // namespace cairn
