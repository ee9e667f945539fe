#include "grid/medial_axis.hpp"

#include "base/validator.hpp"
#include "grid/axis_update.hpp"

namespace cairn {

Status validate(const MedialAxisOptions& options) {
  return Validator("medial_axis")
      .within("min_clearance_m", options.min_clearance_m, 0.0, 100.0)
      .within("coastal_distance_m", options.coastal_distance_m, 0.0, 100.0)
      .within("min_basis_angle_rad", options.min_basis_angle_rad, 0.01, 3.14)
      .status();
}

MedialAxis medial_axis(const DistanceTransform& distances,
                       Cell start,
                       const MedialAxisOptions& options) {
  return AxisUpdate().first(distances, start, options);
}

}  // namespace cairn
