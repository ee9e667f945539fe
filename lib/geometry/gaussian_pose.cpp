#include "geometry/gaussian_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace cairn {

GaussianPose compounded(const GaussianPose& T_a_b, const GaussianPose& T_b_c) {
  const Pose2 T_a_c = T_a_b.mean * T_b_c.mean;
  const double c = std::cos(T_a_b.mean.theta());
  const double s = std::sin(T_a_b.mean.theta());
  Matrix3d by_first = Matrix3d::Identity();
  by_first(0, 2) = -(T_a_c.y() - T_a_b.mean.y());
  by_first(1, 2) = T_a_c.x() - T_a_b.mean.x();
  Matrix3d by_second;
  by_second << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return {T_a_c, by_first * T_a_b.covariance * by_first.transpose() +
                     by_second * T_b_c.covariance * by_second.transpose()};
}

GaussianPose inverted(const GaussianPose& T_a_b) {
  const Pose2 T_b_a = T_a_b.mean.inverse();
  const double c = std::cos(T_a_b.mean.theta());
  const double s = std::sin(T_a_b.mean.theta());
  Matrix3d jacobian;
  jacobian << -c, -s, T_b_a.y(), s, -c, -T_b_a.x(), 0.0, 0.0, -1.0;
  return {T_b_a, jacobian * T_a_b.covariance * jacobian.transpose()};
}

bool is_positive_definite(const Matrix3d& covariance) {
  if (!covariance.allFinite()) {
    return false;
  }
  const double scale = covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale) {
    return false;
  }
  return covariance.llt().info() == Eigen::Success && covariance.determinant() > 0.0;
}

double squared_mahalanobis(const Pose2& a, const Pose2& b, const Matrix3d& covariance) {
  const Eigen::Vector3d difference(a.x() - b.x(), a.y() - b.y(),
                                   turn_between(b.theta(), a.theta()));
  return difference.dot(covariance.llt().solve(difference));
}

}  // namespace cairn
