#pragma once

#include "base/result.hpp"

namespace cairn {

/// How two occupancy grids are laid over each other.
struct MapMatchOptions {
  double search_range_m = 1.5;    ///< Half the window around the guess. [0, 20]
  double search_turn_rad = 0.35;  ///< Half the window around the guess. [0, 3.2]
  double hit_sigma_m =
      0.07;  ///< Spread of a wall of one map around the same wall of the other. > 0
  double min_overlap_share = 0.2;  ///< Less common ground is no evidence. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const MapMatchOptions& options);

}  // namespace cairn
