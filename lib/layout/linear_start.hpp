#pragma once

#include "layout/travel_residual.hpp"

namespace cairn {

/// A start for the place layout that no drift can spoil, from two linear problems: all headings as
/// unit vectors in the plane (the chordal relaxation), then all positions with these headings. Part
/// of the place layout; not for other layers. Where these are singular to rounding, as with
/// uncertainties very far apart, the places are chained along the least uncertain ways instead.
///
/// Source: the initialisation by rotations first of Carlone, Tron, Daniilidis and Dellaert, ICRA
/// 2015.
/// @pre all places are joined by travels, and numbered by elimination_order (or it takes longer)
[[nodiscard]] PlaceVector linear_start(int place_count,
                                       const std::vector<TravelConstraint>& travels);

}  // namespace cairn
