#pragma once

#include <cstdint>

#include "clients/sim/geometry.hpp"
#include "clients/sim/random_source.hpp"

namespace cairn::sim {

/// Errors of dead reckoning. The systematic ones (a worn wheel) are the same on the whole tour, the
/// random ones (slip) grow with the root of what was driven or turned.
struct OdometerOptions {
  double scale_error = 0.02;           ///< Share by which distances are measured too long.
  double turn_bias_rad_per_m = 0.004;  ///< Heading error by driving, counterclockwise.
  double turn_scale_error = 0.01;      ///< Share by which turns are measured too large.
  double distance_noise_m_per_sqrt_m = 0.02;
  double heading_noise_rad_per_sqrt_m = 0.01;
  double heading_noise_rad_per_sqrt_rad = 0.02;
};

/// Dead reckoning of a robot, with its drift; starts at the origin.
class Odometer {
 public:
  Odometer(const OdometerOptions& options, std::uint64_t seed);

  /// Adds what the robot did for a short time.
  void add(const Motion& true_motion);

  /// T_odom_robot
  [[nodiscard]] const Pose& pose() const { return pose_; }

 private:
  OdometerOptions options_;
  RandomSource random_;
  Pose pose_;
};

}  // namespace cairn::sim
