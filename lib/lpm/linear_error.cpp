#include "lpm/linear_error.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kOutlierInSigmas2 = 9.0;  // from here on an error weighs half

}  // namespace

LinearError::LinearError(const Vector2d& sigmas, double bound_sigmas, double memory_lessons)
    : sigmas_(sigmas),
      bound_sigmas_(bound_sigmas),
      keep_(1.0 - 1.0 / memory_lessons),
      covariance_(sigmas.cwiseAbs2().asDiagonal()) {}

void LinearError::forget(const Vector2d& parts) {
  const Vector2d touched = covariance_ * parts;
  const double spread = parts.dot(touched);
  if (spread > 0.0) {
    covariance_ += (1.0 / keep_ - 1.0) / spread * touched * touched.transpose();
  }
  const Vector2d too_wide = covariance_.diagonal().cwiseSqrt().cwiseQuotient(sigmas_);
  const Vector2d shrink = too_wide.cwiseMax(1.0).cwiseInverse();
  covariance_ = (shrink.asDiagonal() * covariance_ * shrink.asDiagonal()).eval();
}

void LinearError::learn(const Vector2d& parts, double error, double variance) {
  forget(parts);
  const Vector2d reach = covariance_ * parts;
  const double explained = parts.dot(reach);
  const double weighed =
      variance * (1.0 + error * error / ((variance + explained) * kOutlierInSigmas2));
  const Vector2d gain = reach / (explained + weighed);
  covariance_ -= gain * reach.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  const Vector2d bound = bound_sigmas_ * sigmas_;
  shares_ = (shares_ + gain * error).cwiseMax(-bound).cwiseMin(bound);
}

}  // namespace cairn
