#include "place/place_options.hpp"

#include "base/validator.hpp"

namespace cairn {

Status validate(const PlaceOptions& options) {
  return Validator("place")
      .within("window_m", options.window_m, 4.0, 100.0)
      .within("cell_m", options.cell_m, 0.01, 1.0)
      .positive("robot_width_m", options.robot_width_m)
      .positive("coastal_distance_m", options.coastal_distance_m)
      .within("speck_m", options.speck_m, 0.0, 10.0)
      .positive("constriction_ahead_m", options.constriction_ahead_m)
      .within("constriction_tolerance_m", options.constriction_tolerance_m, 0.0, 10.0)
      .within("min_corner_rad", options.min_corner_rad, 0.01, 3.14)
      .within("min_gateway_separation_rad", options.min_gateway_separation_rad, 0.0, 3.14)
      .within("doorway_below_m", options.doorway_below_m, 0.0, 100.0)
      .positive("passage_depth_m", options.passage_depth_m)
      .positive("driven_memory_m", options.driven_memory_m)
      .positive("midline_below_m", options.midline_below_m)
      .within("min_distinctiveness", options.min_distinctiveness, 0.0, 1.0)
      .within("recompute_after_m", options.recompute_after_m, 0.0, 100.0)
      .positive("same_spot_m", options.same_spot_m)
      .positive("left_beyond_m", options.left_beyond_m)
      .within("crop_margin_m", options.crop_margin_m, 0.0, 100.0)
      .within("continuation.max_turn_rad", options.continuation.max_turn_rad, 0.01, 3.14)
      .within("continuation.rival_margin_rad", options.continuation.rival_margin_rad, 0.0, 3.14)
      .status();
}

}  // namespace cairn
