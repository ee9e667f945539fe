#pragma once

#include "geometry/pose2.hpp"

namespace cairn {

/// An uncertain T_a_b: mean, and covariance of its coordinates (x, y, theta) in frame a, in m^2,
/// m rad and rad^2.
///
/// Source: Smith, Self and Cheeseman's uncertain spatial relations, as used by Modayil, Beeson and
/// Kuipers, IROS 2004, Sec. IV-C.
struct GaussianPose {
  Pose2 mean;
  Matrix3d covariance = Matrix3d::Zero();
};

/// The uncertain T_a_c of two independent uncertain transforms, to first order.
[[nodiscard]] GaussianPose compounded(const GaussianPose& T_a_b, const GaussianPose& T_b_c);

/// The uncertain T_b_a, to first order.
[[nodiscard]] GaussianPose inverted(const GaussianPose& T_a_b);

/// Whether all entries are finite, the matrix is symmetric and its eigenvalues are greater than 0.
[[nodiscard]] bool is_positive_definite(const Matrix3d& covariance);

/// Squared Mahalanobis length of the difference of two poses in one frame; heading is wrapped.
/// @pre is_positive_definite(covariance)
[[nodiscard]] double squared_mahalanobis(const Pose2& a,
                                         const Pose2& b,
                                         const Matrix3d& covariance);

}  // namespace cairn
