#pragma once

#include <cmath>
#include <numbers>

namespace cairn {

inline constexpr double kPi = std::numbers::pi;

/// The same direction in (-pi, pi]. Angles grow counterclockwise from +x.
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) {
    return angle_rad;
  }
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// The shortest turn from one direction to another, in (-pi, pi].
[[nodiscard]] inline double turn_between(double from_rad, double to_rad) {
  return wrap_angle(to_rad - from_rad);
}

}  // namespace cairn
