#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/result.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"
#include "sensing/sonar_ring.hpp"

namespace cairn {

/// A laser of the robot. In the configuration file: an element of "lasers".
struct LaserChannelOptions {
  std::string channel = "LASER";
  Pose2 T_robot_laser;  ///< Mounting pose; vulcan's own one, if in the message, is put upon it.
  double theta_sign =
      -1.0;  ///< Sense of the angles in mbot's lidar_t: -1 clockwise, 1 counterclockwise.
  double min_range_m = 0.0;  ///< Shorter readings are no statement. >= 0
  double max_range_m = 0.0;  ///< Longer readings are no return. 0: what the message says.
};

[[nodiscard]] Status validate(const LaserChannelOptions& options);

/// What the bytes of a laser message say, whatever its type; the fingerprint tells which:
/// cairn_lcm laser_scan_t, bot_core planar_lidar_t, mbot lidar_t, vulcan laser_t and laser_3dof_t.
///
/// Readings take the meaning of LaserScan, from each sensor's own convention: NaN, zero and
/// negative ones are no statement; infinite ones, and those beyond the range limit, no return.
/// Where neither options nor message give a limit, it is the longest reading of the scan.
///
/// @return the scan, which fulfils validate(); or kMalformed: the bytes are no message; kNotFound:
/// a type nobody knows; kInvalidValue: a message that cannot be a scan
[[nodiscard]] Result<LaserScan> scan_of(const std::uint8_t* bytes,
                                        std::size_t size,
                                        const LaserChannelOptions& options);

/// The same for odometry: cairn_lcm odometry_t, bot_core pose_t (its yaw), mbot pose2D_t, which
/// was pose_xyt_t and odometry_t before, vulcan odometry_t.
[[nodiscard]] Result<OdometrySample> odometry_of(const std::uint8_t* bytes, std::size_t size);

/// The same for a ring of sonars: cairn_lcm sonar_ring_t.
[[nodiscard]] Result<SonarRing> sonar_of(const std::uint8_t* bytes, std::size_t size);

}  // namespace cairn
