#pragma once

#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/distance_field.hpp"

namespace cairn {

/// A return, and across which direction the surface lies that it came from.
struct SurfacePoint {
  Vector2d p;                          ///< m
  Vector2d normal = Vector2d::Zero();  ///< Unit length, of either sign; zero where not known.
};

/// How returns weigh in least squares.
struct RefinementOptions {
  double hit_sigma_m = 0.05;       ///< > 0
  double independent_share = 0.1;  ///< Share of the returns that count as independent. (0, 1]
};

/// Where least squares has come to.
struct Refinement {
  Pose2 T_lpm_robot;
  /// Of the returns alone, of (x, y, theta) in the lpm frame: each tells where the robot is across
  /// its surface, and nothing along it. May be singular.
  Matrix3d information = Matrix3d::Zero();
  /// Standard deviation of the returns about the surfaces, as far as it was measured; else that of
  /// the options.
  double spread_m = 0.0;
  double cost = 0.0;  ///< Half the sum of squares of returns (robust) and prior, in sigmas.
};

/// Lays points onto walls: the pose that minimizes the robust squares of their distances to the
/// walls, and of the deviation from a prior, from a starting pose.
///
/// Levenberg-Marquardt on a distance field as in Hector SLAM (Kohlbrecher et al., SSRR 2011), with
/// Cauchy's loss since people and new walls are in no map.
/// @param points in the robot frame
/// @param prior T_lpm_robot; its covariance must be positive definite
[[nodiscard]] Refinement refine(const DistanceField& walls,
                                const std::vector<SurfacePoint>& points,
                                const GaussianPose& prior,
                                const Pose2& start,
                                const RefinementOptions& options);

}  // namespace cairn
