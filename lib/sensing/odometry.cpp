#include "sensing/odometry.hpp"

#include <cmath>

namespace cairn {

Status validate(const OdometrySample& sample) {
  constexpr double kMaxExtent_m = 1e6;
  const Pose2& pose = sample.T_odom_robot;
  if (std::abs(pose.x()) <= kMaxExtent_m && std::abs(pose.y()) <= kMaxExtent_m &&
      std::isfinite(pose.theta())) {
    return {};
  }
  return Error{ErrorCode::kInvalidValue,
               "odometry: coordinates must be finite and within 1e6 m of the origin"};
}

}  // namespace cairn
