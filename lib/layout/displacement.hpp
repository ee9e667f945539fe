#pragma once

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"

namespace cairn {

/// The displacement of one travel: where the place of arrival lies in the frame of the place of
/// departure, T_from_to, composed of three independent uncertain vectors:
///
///     lambda_i = L_{i-1} (+) [x_{i,0}]_{m_{i-1}} (+) (-)L_i
///
/// The covariances come from matching scans and maps, never from a formula of the distance. Three
/// certain (zero) parts give a zero covariance; `validate_displacement` is the door for what the
/// place layout takes.
///
/// @param T_place_robot_at_departure L_{i-1}: the robot in the frame of the place it leaves
/// @param T_departure_arrival the robot at arrival, in its own frame at departure (frame of
/// m_{i-1})
/// @param T_place_robot_at_arrival L_i: the robot in the frame of the place it reached
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-C, Eq. (14): F(lambda). To first order,
/// as in Smith, Self and Cheeseman.
[[nodiscard]] GaussianPose displacement(const GaussianPose& T_place_robot_at_departure,
                                        const GaussianPose& T_departure_arrival,
                                        const GaussianPose& T_place_robot_at_arrival);

/// Nothing wrong with a displacement: finite mean, finite positive definite covariance whose
/// standard deviations are at least 1e-6 m and rad. Otherwise kInvalidValue, saying what is wrong.
[[nodiscard]] Status validate_displacement(const GaussianPose& T_from_to);

}  // namespace cairn
