#pragma once

#include <Eigen/Core>

namespace cairn {

/// Learns an error that is proportional to two parts of a motion, to driving and to turning, say:
/// error = share(0) * part(0) + share(1) * part(1) + chance.
///
/// Recursive least squares. What is older fades exponentially, in the direction of each lesson only
/// (Kulhavy's directional forgetting), so that what the lessons do not touch is not forgotten. The
/// variances never grow beyond those of the beginning, gross errors weigh little, and the shares
/// never leave their bounds.
class LinearError {
 public:
  using Vector2d = Eigen::Vector2d;

  /// @param sigmas of both shares around 0, beforehand; > 0
  /// @param bound_sigmas how many of these the shares may reach, > 0
  /// @param memory_lessons what is older has faded, > 1
  LinearError(const Vector2d& sigmas, double bound_sigmas, double memory_lessons);

  /// @param error what was left over beside what these shares explain
  /// @param variance of the chance in it, > 0
  void learn(const Vector2d& parts, double error, double variance);

  [[nodiscard]] const Vector2d& shares() const { return shares_; }
  /// Variance of what the shares explain, as far as they are uncertain.
  [[nodiscard]] double variance(const Vector2d& parts) const {
    return parts.dot(covariance_ * parts);
  }

 private:
  void forget(const Vector2d& parts);

  Vector2d sigmas_;
  double bound_sigmas_;
  double keep_;
  Vector2d shares_ = Vector2d::Zero();
  Eigen::Matrix2d covariance_;
};

}  // namespace cairn
