#pragma once

#include <array>

#include "geometry/pose2.hpp"

namespace cairn {

/// A boundary between a place neighbourhood and a path that leads away from it: the line that joins
/// a constriction of the medial axis with its two basis points on the obstacles. Coordinates in the
/// frame that the holder names.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-B.
struct Gateway {
  /// Ends of the line on the obstacles; the right hand one of a robot that travels outward first.
  std::array<Vector2d, 2> basis_points{Vector2d::Zero(), Vector2d::Zero()};
  Vector2d middle = Vector2d::Zero();  ///< The point of the axis; not always halfway.
  double width_m = 0.0;                ///< Length of the line.
  double outward_bearing_rad = 0.0;  ///< Direction of the axis beyond it, counterclockwise from +x.
  double seen_beyond_m = 0.0;        ///< Way along walls known beyond the line, along the axis.

  [[nodiscard]] Vector2d outward() const {
    return {std::cos(outward_bearing_rad), std::sin(outward_bearing_rad)};
  }
};

/// The same gateway in another frame.
[[nodiscard]] Gateway transformed(const Pose2& T_to_from, const Gateway& gateway);

/// Which way, if any, the straight move from `a` to `b` crosses the line: +1 outward, -1 inward, 0
/// not at all. The line is taken `slack_m` longer at either end, as walls have no exact place.
[[nodiscard]] int crossing(const Gateway& gateway,
                           const Vector2d& a,
                           const Vector2d& b,
                           double slack_m);

/// How far a point lies beyond the line, along its outward direction; negative inside.
[[nodiscard]] double distance_beyond_m(const Gateway& gateway, const Vector2d& p);

/// Whether two readings of gateways, in one frame, are about the same one.
[[nodiscard]] bool is_same_gateway(const Gateway& a, const Gateway& b);

}  // namespace cairn
