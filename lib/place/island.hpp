#pragma once

#include <vector>

#include "place/local_view.hpp"

namespace cairn {

/// What the walls that are visible from a point say about the pose of a robot there.
struct IslandMeasure {
  /// Strengths of the constraints: along the direction that is told best, across it, and of the
  /// heading. Sums over bearings, radians: about 2.8 of each amid a small square room.
  double dominating = 0.0;
  double weaker = 0.0;
  double heading = 0.0;
  double quality = 0.0;          ///< Weaker by dominating: 1 where error bounds are round. [0, 1]
  double distinctiveness = 0.0;  ///< All in one: how reliably the pose is told. [0, 1]
};

/// A wall as it is seen from a point: a run of neighbouring hits on one line.
struct VisibleWall {
  Vector2d normal = Vector2d::Zero();  ///< Unit length, to the viewer.
  double influence = 0.0;              ///< Length of its vector of influence.
  double lever_m = 0.0;                ///< Spread of its hits along it.
};

/// The walls that are visible from a point, by casting rays all around; unknown space shows none.
[[nodiscard]] std::vector<VisibleWall> visible_walls(const LocalView& view, const Vector2d& p_map);

/// The measure from the walls.
[[nodiscard]] IslandMeasure island_measure(const std::vector<VisibleWall>& walls);

/// How well range readings fix a pose at a point. 0 where no walls are in sight or the point is not
/// free; near 0 in a corridor whose ends are far; 1 near walls of two orthogonal directions.
///
/// Each visible wall has a vector of influence along its normal: the sum over viewing directions of
/// the cosine of incidence, weakened by exp(-range / constant), as near walls are seen more surely.
/// The longest of them names one of two orthogonal directions; the components of all vectors along
/// either are summed. The smaller sum, through a sigmoid and weighted by the quality of
/// orthogonality, decides. With a laser instead of sonar no angle of incidence is too flat; the
/// heading, which the paper leaves out, is told by the spread of hits along walls and may decide as
/// well. The neighbourhood that the paper integrates over is a point, as in its own results.
///
/// Source: Simhon and Dudek, IROS 1998, "Local map distinctiveness measure".
[[nodiscard]] IslandMeasure island_at(const LocalView& view, const Vector2d& p_map);

}  // namespace cairn
