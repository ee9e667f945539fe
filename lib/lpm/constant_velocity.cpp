#include "lpm/constant_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "lpm/robust_scale.hpp"

namespace cairn {
namespace {

constexpr double kLeastSpan_s = 0.2;  // stamps shake
constexpr double kLongestSpan_s = 1.0;
constexpr double kFirstSpeedVariance = 0.25;     // (0.5 m/s)^2
constexpr double kFirstTurnRateVariance = 0.49;  // (0.7 rad/s)^2
constexpr double kVelocityGain = 0.1;
constexpr double kLeastVelocityShare = 0.04;  // of the first variances

}  // namespace

GaussianPose ConstantVelocity::predict(double dt_s) const {
  const double span_s = std::clamp(dt_s, 0.0, kLongestSpan_s);
  const double unsure2 = std::pow(std::max(kLeastSpan_s, span_s), 2);
  Matrix3d covariance = Matrix3d::Zero();
  covariance.diagonal() << speed_variance_ * unsure2, speed_variance_ * unsure2,
      turn_rate_variance_ * unsure2;
  const Pose2 half(0.0, 0.0, 0.5 * turn_rate_rad_per_s_ * span_s);
  return {Pose2(half * Vector2d(speed_m_per_s_ * span_s, 0.0), turn_rate_rad_per_s_ * span_s),
          covariance};
}

void ConstantVelocity::learn(const Pose2& motion, double dt_s) {
  if (!(dt_s > 0.0)) {
    return;
  }
  const Vector2d along = Pose2(0.0, 0.0, -0.5 * motion.theta()) * motion.translation();
  const double speed = std::clamp(along.x() / dt_s, -max_speed_m_per_s_, max_speed_m_per_s_);
  const double turn_rate =
      std::clamp(motion.theta() / dt_s, -max_turn_rate_rad_per_s_, max_turn_rate_rad_per_s_);
  const auto climb = [](double change, double first, double* variance) {
    *variance = std::clamp(*variance * std::exp(kVelocityGain * scale_score(change, *variance)),
                           kLeastVelocityShare * first, first / kLeastVelocityShare);
  };
  climb(speed - speed_m_per_s_, kFirstSpeedVariance, &speed_variance_);
  climb(turn_rate - turn_rate_rad_per_s_, kFirstTurnRateVariance, &turn_rate_variance_);
  speed_before_m_per_s_ = speed_m_per_s_;
  turn_rate_before_rad_per_s_ = turn_rate_rad_per_s_;
  speed_m_per_s_ = speed;
  turn_rate_rad_per_s_ = turn_rate;
  steps_ = std::min(steps_ + 1, 2);
}

Twist ConstantVelocity::recent() const {
  if (steps_ < 2) {
    return {};
  }
  return {0.5 * (speed_m_per_s_ + speed_before_m_per_s_), 0.0,
          0.5 * (turn_rate_rad_per_s_ + turn_rate_before_rad_per_s_)};
}

void ConstantVelocity::reset() {
  speed_m_per_s_ = 0.0;
  turn_rate_rad_per_s_ = 0.0;
  steps_ = 0;
  speed_variance_ = kFirstSpeedVariance;
  turn_rate_variance_ = kFirstTurnRateVariance;
}

}  // namespace cairn
