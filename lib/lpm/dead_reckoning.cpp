#include "lpm/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cairn {
namespace {

constexpr double kLeastTimeStep_s = 1.0;  // recorded stamps are not to be trusted below this
constexpr double kLeastTwistStep_s = 1e-3;
constexpr double kDetour_m =
    1.0;  // less is the robot's swaying, and what samples and scans are apart
constexpr double kDriven_m = 0.05;
constexpr double kTurned_rad = 0.05;

}  // namespace

DeadReckoning::DeadReckoning(const MotionOptions& options, const MotionWatchOptions& watch)
    : options_(options),
      limits_(watch),
      model_(options.learning),
      velocity_(watch.max_speed_m_per_s, watch.max_turn_rate_rad_per_s),
      watch_(watch) {}

void DeadReckoning::start(TimePoint time, const std::optional<Pose2>& T_odom_robot) {
  time_ = time;
  T_odom_robot_ = T_odom_robot;
  lag_.interrupt();
  if (T_odom_robot) {
    lag_.add(time, *T_odom_robot);
  }
  velocity_.reset();
  model_.skip();
  watch_.interrupt();
}

void DeadReckoning::begin(const JoinedScan& joined) {
  dt_s_ = seconds_between(time_, joined.scan.time);
  T_odom_step_.reset();
  is_possible_ = false;
  if (T_odom_robot_ && joined.T_odom_robot) {
    T_odom_step_ = T_odom_robot_->inverse() * *joined.T_odom_robot;
    const double possible_s = std::max(std::abs(dt_s_), kLeastTimeStep_s);
    is_possible_ = T_odom_step_->translation().norm() <= limits_.max_speed_m_per_s * possible_s &&
                   std::abs(T_odom_step_->theta()) <= limits_.max_turn_rate_rad_per_s * possible_s;
  }
  detour_m_ = T_odom_step_ ? joined.odom_way_m - T_odom_step_->translation().norm() : 0.0;
  time_ = joined.scan.time;
  T_odom_robot_ = joined.T_odom_robot;
  take_off_lag();
  note_repeat(joined.scan);
}

void DeadReckoning::take_off_lag() {
  if (!is_possible_) {
    lag_.interrupt();
  }
  if (T_odom_robot_) {
    lag_.add(time_, *T_odom_robot_);
  }
  if (is_possible_ && lag_.lag_s() > 0.0) {
    T_odom_step_ = lag_.step().value_or(*T_odom_step_);
  }
}

void DeadReckoning::note_repeat(const LaserScan& scan) {
  const std::size_t bytes = scan.ranges_m.size() * sizeof(float);
  is_scan_repeated_ = bytes > 0 && scan.ranges_m.size() == ranges_m_.size() &&
                      std::memcmp(scan.ranges_m.data(), ranges_m_.data(), bytes) == 0;
  ranges_m_ = scan.ranges_m;
}

Twist DeadReckoning::twist() const {
  if (is_possible_ && dt_s_ >= kLeastTwistStep_s && dt_s_ <= kLeastTimeStep_s &&
      T_odom_step_->translation().norm() <= limits_.max_speed_m_per_s * dt_s_ &&
      std::abs(T_odom_step_->theta()) <= limits_.max_turn_rate_rad_per_s * dt_s_) {
    return {T_odom_step_->x() / dt_s_, T_odom_step_->y() / dt_s_, T_odom_step_->theta() / dt_s_};
  }
  const bool is_steady = dt_s_ >= kLeastTwistStep_s && dt_s_ <= kLeastTimeStep_s;
  return !T_odom_step_ && is_steady ? velocity_.recent() : Twist{};
}

GaussianPose DeadReckoning::predicted() const {
  if (!is_possible_) {
    return continued();
  }
  GaussianPose step = model_.predict(*T_odom_step_);
  if (detour_m_ > kDetour_m) {
    // The errors of the way around, in whichever direction it went.
    const Matrix3d around = model_.predict(Pose2(detour_m_, 0.0, 0.0)).covariance;
    const double variance_m2 = around(0, 0) + around(1, 1);
    step.covariance += Eigen::Vector3d(variance_m2, variance_m2, around(2, 2)).asDiagonal();
  }
  return widened(step);
}

bool DeadReckoning::is_scan_frozen() const {
  return is_scan_repeated_ && is_possible_ &&
         (T_odom_step_->translation().norm() > kDriven_m ||
          std::abs(T_odom_step_->theta()) > kTurned_rad);
}

GaussianPose DeadReckoning::widened(GaussianPose motion) const {
  motion.covariance *= options_.widening;
  motion.covariance.diagonal() +=
      Eigen::Vector3d(options_.least_sigma_m, options_.least_sigma_m, options_.least_sigma_rad)
          .cwiseAbs2();
  return motion;
}

MotionFault DeadReckoning::end(const std::optional<GaussianPose>& matched) {
  if (matched) {
    velocity_.learn(matched->mean, dt_s_);
  } else {
    velocity_.reset();
  }
  if (!matched || !T_odom_step_) {
    model_.skip();
    watch_.interrupt();
    return has_jumped()       ? MotionFault::kTeleport
           : is_scan_frozen() ? MotionFault::kScanStalled
                              : MotionFault::kNone;
  }
  if (is_possible_) {
    lag_.learn(matched->mean.theta());
  }
  const MotionFault fault = watch_.judge(
      {dt_s_, *T_odom_step_, model_.predict(*T_odom_step_), *matched, is_scan_repeated_});
  if (fault == MotionFault::kNone && options_.learns) {
    model_.learn(*T_odom_step_, *matched);
  } else {
    model_.skip();
  }
  return fault;
}

}  // namespace cairn
