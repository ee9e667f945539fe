#pragma once

#include <vector>

#include "place/gateway.hpp"
#include "place/local_view.hpp"

namespace cairn {

/// The passable free space of a neighbourhood: what can be reached without crossing a gateway.
struct PlaceRegion {
  bool is_complete =
      false;  ///< No unknown stretch as wide as the robot, and not cut by the window.
  bool contains_robot = false;
  double radius_m = 0.0;  ///< From the centre to the farthest wall or gateway of the region.
};

/// Floods the passable cells from the given ones.
/// @param gateways lines not to cross, in the frame of the map, as are all coordinates
[[nodiscard]] PlaceRegion flooded_region(const LocalView& view,
                                         const std::vector<Cell>& starts,
                                         const std::vector<Gateway>& gateways,
                                         const Vector2d& center,
                                         double robot_width_m);

}  // namespace cairn
