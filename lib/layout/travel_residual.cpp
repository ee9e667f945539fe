#include "layout/travel_residual.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace cairn {

Eigen::Vector3d TravelResidual::at(const Eigen::Vector3d& global_from,
                                   const Eigen::Vector3d& global_to,
                                   Matrix3d* by_from,
                                   Matrix3d* by_to) const {
  const double c = std::cos(global_from.z());
  const double s = std::sin(global_from.z());
  const double dx = global_to.x() - global_from.x();
  const double dy = global_to.y() - global_from.y();
  const Eigen::Vector3d predicted(c * dx + s * dy, -s * dx + c * dy, 0.0);
  if (by_from != nullptr) {
    Matrix3d jacobian;
    jacobian << -c, -s, predicted.y(), s, -c, -predicted.x(), 0.0, 0.0, -1.0;
    *by_from = whitening * jacobian;
  }
  if (by_to != nullptr) {
    Matrix3d jacobian;
    jacobian << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
    *by_to = whitening * jacobian;
  }
  return whitening * Eigen::Vector3d(predicted.x() - measured.x(), predicted.y() - measured.y(),
                                     wrap_angle(global_to.z() - global_from.z() - measured.z()));
}

TravelResidual residual_of(const TravelConstraint& travel) {
  const Eigen::LLT<Matrix3d> cholesky(travel.T_from_to.covariance);
  const Matrix3d lower = cholesky.matrixL();
  TravelResidual residual;
  residual.from = travel.from;
  residual.to = travel.to;
  const Pose2& mean = travel.T_from_to.mean;
  residual.measured = {mean.x(), mean.y(), mean.theta()};
  residual.whitening = lower.triangularView<Eigen::Lower>().solve(Matrix3d::Identity());
  residual.log_det_covariance = 2.0 * lower.diagonal().array().log().sum();
  return residual;
}

}  // namespace cairn
