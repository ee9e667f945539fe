#pragma once

#include <vector>

#include "geometry/pose2.hpp"

namespace cairn {

/// How well range readings of the walls around fix a position in both directions, in [0, 1]: 0 in a
/// corridor without ends, 1 where walls of all orientations are seen alike. Takes the unit normals
/// of the wall points; a reading of a wall fixes the position along its normal, so the smaller
/// eigenvalue of the sum of their outer products, relative to the mean, tells about the worst
/// direction.
///
/// Source: the line-segment measure of Simhon and Dudek, IROS 1998 (islands of reliability), in the
/// form of an information matrix. 0 where there are no walls.
[[nodiscard]] double distinctiveness(const std::vector<Vector2d>& wall_normals);

}  // namespace cairn
