#include "layout/trajectory.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace cairn {
namespace {

/// A turn of one radian counts in the share of the motion as so much driving.
constexpr double kTurnLever_m = 0.5;

/// What part of the motion lies before each pose: 0 for the first, 1 for the last.
struct Shares {
  std::vector<double> of_motion;    ///< Driving and turning.
  std::vector<double> of_distance;  ///< Driving alone.
};

double distance_between(const Pose2& a, const Pose2& b) {
  return std::hypot(b.x() - a.x(), b.y() - a.y());
}

/// Sums to shares; by number where nothing was summed.
void normalize(std::vector<double>* sums) {
  const double total = sums->back();
  const double last = static_cast<double>(sums->size() - 1);
  for (std::size_t i = 0; i < sums->size(); ++i) {
    (*sums)[i] = total > 0.0 ? (*sums)[i] / total : static_cast<double>(i) / last;
  }
}

/// @pre at least two poses
Shares shares_of(const std::vector<Pose2>& path) {
  Shares shares{{0.0}, {0.0}};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double driven_m = distance_between(path[i - 1], path[i]);
    const double turned_rad = std::abs(turn_between(path[i - 1].theta(), path[i].theta()));
    shares.of_distance.push_back(shares.of_distance.back() + driven_m);
    shares.of_motion.push_back(shares.of_motion.back() + driven_m + kTurnLever_m * turned_rad);
  }
  if (shares.of_distance.back() <= 0.0) {
    shares.of_distance = shares.of_motion;  // Turning on the spot.
  }
  normalize(&shares.of_distance);
  normalize(&shares.of_motion);
  return shares;
}

/// The path from T_global_first on, each step turned by its share of a correction of heading.
std::vector<Pose2> bent(const std::vector<Pose2>& path,
                        const std::vector<double>& shares,
                        const Pose2& T_global_first,
                        double correction_rad) {
  const double turn_rad = T_global_first.theta() - path.front().theta();
  std::vector<Pose2> poses{T_global_first};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double midway = 0.5 * (shares[i - 1] + shares[i]);
    const Eigen::Rotation2Dd R_global_lpm(turn_rad + midway * correction_rad);
    const Vector2d step = R_global_lpm * (path[i].translation() - path[i - 1].translation());
    poses.emplace_back(poses.back().translation() + step,
                       path[i].theta() + turn_rad + shares[i] * correction_rad);
  }
  return poses;
}

/// Covariance that motion adds on top of nothing, pose by pose, from the first to the last.
std::vector<Matrix3d> grown(const std::vector<Pose2>& poses, const MotionNoise& noise) {
  std::vector<Matrix3d> covariances{Matrix3d::Zero()};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double driven_m = distance_between(poses[i - 1], poses[i]);
    const double turned_rad = std::abs(turn_between(poses[i - 1].theta(), poses[i].theta()));
    Matrix3d by_previous = Matrix3d::Identity();  // A heading error moves what follows.
    by_previous(0, 2) = -(poses[i].y() - poses[i - 1].y());
    by_previous(1, 2) = poses[i].x() - poses[i - 1].x();
    Matrix3d covariance = by_previous * covariances.back() * by_previous.transpose();
    covariance(0, 0) += noise.variance_m2_per_m * driven_m;
    covariance(1, 1) += noise.variance_m2_per_m * driven_m;
    covariance(2, 2) +=
        noise.variance_rad2_per_m * driven_m + noise.variance_rad2_per_rad * turned_rad;
    covariances.push_back(covariance);
  }
  return covariances;
}

/// Covariance of the product of two Gaussians of one mean: a (a + b)^-1 b.
Matrix3d fused(const Matrix3d& a, const Matrix3d& b) {
  const Matrix3d sum = a + b;
  const double scale = sum.diagonal().maxCoeff();
  if (!(scale > 0.0)) {
    return Matrix3d::Zero();
  }
  // Keeps the sum invertible where a robot did not move; vanishes beside any real uncertainty.
  const Matrix3d regular = sum + 1e-12 * scale * Matrix3d::Identity();
  const Matrix3d product = a * regular.inverse() * b;
  return 0.5 * (product + product.transpose());
}

}  // namespace

std::vector<Pose2> interpolate_travel(const std::vector<Pose2>& T_lpm_robot,
                                      const Pose2& T_global_first,
                                      const Pose2& T_global_last) {
  if (T_lpm_robot.empty()) {
    return {};
  }
  if (T_lpm_robot.size() == 1) {
    return {T_global_first};
  }
  const Shares shares = shares_of(T_lpm_robot);
  const double correction_rad =
      wrap_angle(turn_between(T_global_first.theta(), T_global_last.theta()) -
                 turn_between(T_lpm_robot.front().theta(), T_lpm_robot.back().theta()));
  std::vector<Pose2> poses = bent(T_lpm_robot, shares.of_motion, T_global_first, correction_rad);
  const Vector2d left = T_global_last.translation() - poses.back().translation();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = Pose2(poses[i].translation() + shares.of_distance[i] * left, poses[i].theta());
  }
  poses.back() = T_global_last;
  return poses;
}

std::vector<GaussianPose> interpolate_uncertain_travel(const std::vector<Pose2>& T_lpm_robot,
                                                       const GaussianPose& T_global_first,
                                                       const GaussianPose& T_global_last,
                                                       const MotionNoise& noise) {
  const std::vector<Pose2> poses =
      interpolate_travel(T_lpm_robot, T_global_first.mean, T_global_last.mean);
  if (poses.size() < 2) {
    return std::vector<GaussianPose>(poses.size(), T_global_first);
  }
  const std::vector<Matrix3d> forward = grown(poses, noise);
  const std::vector<Matrix3d> backward = grown({poses.rbegin(), poses.rend()}, noise);
  const std::vector<double> shares = shares_of(T_lpm_robot).of_motion;
  std::vector<GaussianPose> uncertain;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Matrix3d ends =
        (1.0 - shares[i]) * T_global_first.covariance + shares[i] * T_global_last.covariance;
    uncertain.push_back({poses[i], ends + fused(forward[i], backward[poses.size() - 1 - i])});
  }
  return uncertain;
}

}  // namespace cairn
