#pragma once

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// The robot's pose by dead reckoning, in a frame of its own that drifts.
struct OdometrySample {
  TimePoint time;
  Pose2 T_odom_robot;
};

/// Finite coordinates within 1e6 m.
[[nodiscard]] Status validate(const OdometrySample& sample);

}  // namespace cairn
