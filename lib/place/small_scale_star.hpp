#pragma once

#include <vector>

#include "place/gateway.hpp"
#include "place/path_fragments.hpp"
#include "star/star.hpp"

namespace cairn {

/// Sorts gateways clockwise around a centre, by where the straight way outward through each leaves
/// a circle around the neighbourhood.
void sort_clockwise(const Vector2d& center, std::vector<Gateway>* gateways);

/// The star of a place: outward gateways in clockwise order; a terminated end is inserted where the
/// straight way inward through its gateway would leave the neighbourhood on the far side. By
/// bearing from the centre alone, the ends of Fig. 3(e) would not come out in the order given
/// there: its side corridors do not meet in one point.
///
/// A gateway wider than `midline_below_m` has no midline to follow within the range of sensing; the
/// wall on the right is followed instead.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-C, steps 1 to 3.
/// @pre gateways are sorted clockwise around the centre; each is in exactly one fragment
[[nodiscard]] Star small_scale_star(const Vector2d& center,
                                    const std::vector<Gateway>& gateways,
                                    const std::vector<PathFragment>& fragments,
                                    double midline_below_m);

}  // namespace cairn
