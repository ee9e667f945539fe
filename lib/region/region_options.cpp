#include "region/region_options.hpp"

#include "base/validator.hpp"

namespace cairn {

Status validate(const RegionOptions& options) {
  return Validator("regions")
      .positive("max_line_m", options.max_line_m)
      .within("max_narrowing", options.max_narrowing, 0.01, 0.99)
      .positive("widening", options.widening)
      .positive("doorway_depth_m", options.doorway_depth_m)
      .within("min_area_m2", options.min_area_m2, 0.0, 1e6)
      .within("furniture_size_m", options.furniture_size_m, 0.0, 100.0)
      .status();
}

}  // namespace cairn
