#pragma once

#include <vector>

#include "lpm/scan_matcher.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/scrolling_map.hpp"

namespace cairn {

/// Judges a match by its pose: sets which share of the returns falls on known cells, and which
/// share of those on walls.
/// @param on_wall_m a return this far from a wall still counts as on it
void judge(const ScrollingMap& map,
           const std::vector<SurfacePoint>& returns,
           double on_wall_m,
           ScanMatch* match);

/// Share of the returns that lie behind walls of the map which the beam would have met, [0, 1].
[[nodiscard]] double share_through_walls(const ScrollingMap& map,
                                         const ScanBeams& beams,
                                         const Pose2& T_lpm_robot);

}  // namespace cairn
