#pragma once

#include <cstddef>
#include <vector>

#include "place/axis_sites.hpp"
#include "place/gateway.hpp"
#include "place/local_view.hpp"

namespace cairn {

/// How far each edge of the axis runs along walls.
class WalledLengths {
 public:
  struct Lengths {
    double all_m = 0.0;
    double along_wall_m = 0.0;     ///< With a wall on one side at least.
    double between_walls_m = 0.0;  ///< With walls on both sides.
  };

  explicit WalledLengths(const LocalView& view);

  /// From one position of a way to a later one.
  [[nodiscard]] Lengths between(AxisWay way, std::size_t first, std::size_t last) const;

 private:
  std::vector<std::vector<Lengths>> since_start_;  ///< By edge and cell.
};

/// What was seen behind a line.
struct Passage {
  double along_wall_m = 0.0;     ///< The longest way with a wall on one side at least.
  double between_walls_m = 0.0;  ///< The longest way between walls.
  double to_end_m = 0.0;         ///< The longest way to an end with walls all around.
  bool goes_beyond_map = false;  ///< A way along walls is cut by the edge of the map.
};

/// Looks along the axis behind a line, without coming back into the site. Some of a way may have no
/// walls in sight, if it is little: what a few beams show through a door or a window is bounded by
/// unknown space, and might be no passage at all.
/// @param enough_m nothing beyond is looked at
[[nodiscard]] Passage passage_beyond(const LocalView& view,
                                     const WalledLengths& walled,
                                     const AxisSite& site,
                                     AxisWay way,
                                     std::size_t position,
                                     double enough_m);

/// Whether the robot has gone through a line of late: a passage if ever there was one.
[[nodiscard]] bool is_driven_through(const Gateway& line, const std::vector<Vector2d>& robot_way);

}  // namespace cairn
