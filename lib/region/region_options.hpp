#pragma once

#include "base/result.hpp"

namespace cairn {

/// What counts as a room, a door and a piece of furniture.
struct RegionOptions {
  double max_line_m = 2.5;         ///< A wider opening parts no regions. > 0
  double max_narrowing = 0.75;     ///< Clearance at a line over that of either side. (0, 1)
  double widening = 0.25;          ///< Of free space beyond a doorway, over its width. > 0
  double doorway_depth_m = 0.5;    ///< Free space is that much wider within this. > 0
  double min_area_m2 = 1.5;        ///< Smaller ones join a neighbour, or are none. >= 0
  double furniture_size_m = 0.75;  ///< Longest side of what stands free in a room. >= 0
};

[[nodiscard]] Status validate(const RegionOptions& options);

}  // namespace cairn
