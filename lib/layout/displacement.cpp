#include "layout/displacement.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kLeastSigma = 1e-6;
constexpr double kGreatestSigma = 1e6;

}  // namespace

GaussianPose displacement(const GaussianPose& T_place_robot_at_departure,
                          const GaussianPose& T_departure_arrival,
                          const GaussianPose& T_place_robot_at_arrival) {
  // (14)
  GaussianPose T_from_to = compounded(compounded(T_place_robot_at_departure, T_departure_arrival),
                                      inverted(T_place_robot_at_arrival));
  // Rounding must not make it unsymmetric: the layout factors it.
  T_from_to.covariance = (0.5 * (T_from_to.covariance + T_from_to.covariance.transpose())).eval();
  return T_from_to;
}

Status validate_displacement(const GaussianPose& T_from_to) {
  const Pose2& mean = T_from_to.mean;
  if (!std::isfinite(mean.x()) || !std::isfinite(mean.y()) || !std::isfinite(mean.theta())) {
    return Error{ErrorCode::kInvalidValue, "displacement: the mean must be finite"};
  }
  if (!is_positive_definite(T_from_to.covariance)) {
    return Error{ErrorCode::kInvalidValue,
                 "displacement: the covariance must be finite, symmetric and positive definite"};
  }
  const Eigen::Vector3d sigmas = T_from_to.covariance.diagonal().cwiseSqrt();
  if (sigmas.minCoeff() < kLeastSigma || sigmas.maxCoeff() > kGreatestSigma) {
    return Error{ErrorCode::kInvalidValue,
                 "displacement: standard deviations must be in [1e-6, 1e6] m and rad"};
  }
  return {};
}

}  // namespace cairn
