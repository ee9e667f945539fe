#pragma once

#include "base/result.hpp"
#include "place/path_fragments.hpp"

namespace cairn {

/// How places are found in a local map, and how visits are told. In the configuration file: the
/// object "place".
struct PlaceOptions {
  double window_m = 20.0;      ///< Side of the square around the robot that is looked at. [4, 100]
  double cell_m = 0.1;         ///< Coarsest cell worked with; a finer map is coarsened. (0, 1]
  double robot_width_m = 0.5;  ///< Narrower passages are none. > 0
  double coastal_distance_m = 1.0;    ///< Alcoves less deep are no branches. > 0
  double speck_m = 0.8;               ///< Isolated obstacles up to this extent are ignored. >= 0
  double constriction_ahead_m = 2.0;  ///< Stretch of axis compared for a constriction. > 0
  double constriction_tolerance_m = 0.1;  ///< Roughness of walls. >= 0
  double min_corner_rad = 0.79;           ///< Two gateways less out of line are no place. (0, pi)
  double min_gateway_separation_rad = 0.35;  ///< Gateways closer in bearing are one. [0, pi)
  double doorway_below_m = 1.2;              ///< Narrower openings are doorways, and make no place
                                             ///< until driven through. >= 0
  double passage_depth_m = 4.0;       ///< Way seen along walls that makes an opening a gateway. > 0
  double driven_memory_m = 30.0;      ///< Travel for which the way driven is remembered. > 0
  double midline_below_m = 6.0;       ///< Wider passages are followed by a wall. > 0
  double min_distinctiveness = 0.05;  ///< [0, 1]
  double recompute_after_m = 0.5;     ///< Travel between two looks at the map. >= 0
  double same_spot_m = 0.7;           ///< Two readings of one place lie less apart. > 0
  double left_beyond_m = 0.4;         ///< Distance beyond a gateway at which a place is left. > 0
  double crop_margin_m = 2.0;         ///< Of the stored map around the gateways. >= 0
  ContinuationOptions continuation;
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const PlaceOptions& options);

}  // namespace cairn
