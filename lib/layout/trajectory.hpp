#pragma once

#include <vector>

#include "geometry/gaussian_pose.hpp"

namespace cairn {

/// The poses of one travel in the global frame: its first and last pose are fixed, and the
/// difference to the local map is spread over the poses between, each by its share of the motion.
///
/// The correction of heading is spread first, by turning every step of the path about its start, so
/// that the path bends and is not sheared; what is left of the translation is then spread by the
/// distance driven. Where both ends agree with the local map, the result is the local path moved
/// rigidly. A robot that never moved takes its share by the number of the pose.
///
/// @param T_lpm_robot every pose of the travel in the frame of its local map
/// @param T_global_first where the first pose lies: T_global_place * L of the departure
/// @param T_global_last where the last pose lies: T_global_place * L of the arrival
/// @return as many poses; empty for none; only T_global_first for one
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-E: H(x).
[[nodiscard]] std::vector<Pose2> interpolate_travel(const std::vector<Pose2>& T_lpm_robot,
                                                    const Pose2& T_global_first,
                                                    const Pose2& T_global_last);

/// How uncertainty grows with motion: variances per metre and radian.
struct MotionNoise {
  double variance_m2_per_m = 0.0025;     ///< Of position, in each direction. >= 0
  double variance_rad2_per_m = 0.0004;   ///< Of heading, by driving. >= 0
  double variance_rad2_per_rad = 0.001;  ///< Of heading, by turning. >= 0
};

/// As `interpolate_travel`, with uncertainty: that of the ends, blended by the share of the motion,
/// plus what the motion adds, which grows from both ends at once and is greatest midway.
///
/// @param T_global_first, T_global_last covariances of (x, y, theta) in the global frame
[[nodiscard]] std::vector<GaussianPose> interpolate_uncertain_travel(
    const std::vector<Pose2>& T_lpm_robot,
    const GaussianPose& T_global_first,
    const GaussianPose& T_global_last,
    const MotionNoise& noise = {});

}  // namespace cairn
