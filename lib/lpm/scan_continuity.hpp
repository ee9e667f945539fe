#pragma once

#include <vector>

#include "geometry/pose2.hpp"
#include "lpm/scan_beams.hpp"

namespace cairn {

/// Which share of the returns of a scan has another return of an earlier scan close by: whether the
/// surroundings have gone on as they were, whatever a map says. A robot that drove sees most of
/// what it saw before; one that was carried does not.
/// @param before returns of the earlier scan, in the frame of the robot then
/// @param T_before_now the motion meanwhile; a turn that is off by up to 0.25 rad does not matter
/// @return in [0, 1]; 0 where either scan has no returns
[[nodiscard]] double continuity(const ScanBeams& now,
                                const std::vector<Vector2d>& before,
                                const Pose2& T_before_now);

}  // namespace cairn
