#pragma once

#include "geometry/gaussian_pose.hpp"
#include "lpm/scan_beams.hpp"

namespace cairn {

/// Motion for want of odometry: the robot goes on as it went.
class ConstantVelocity {
 public:
  /// @param max_speed_m_per_s, max_turn_rate_rad_per_s > 0: nothing faster is believed
  ConstantVelocity(double max_speed_m_per_s, double max_turn_rate_rad_per_s)
      : max_speed_m_per_s_(max_speed_m_per_s), max_turn_rate_rad_per_s_(max_turn_rate_rad_per_s) {}

  /// The motion to expect within `dt_s`. A time that is negative counts as none; one that is longer
  /// than a second as a second, for recorded stamps are not to be trusted so far. The covariance is
  /// positive definite.
  [[nodiscard]] GaussianPose predict(double dt_s) const;
  /// Ahead and turning over the last two steps: good enough to tell what a sweep saw at which time.
  /// The last step alone is not. A scan that was bent too much by that speed is matched as turned
  /// by half of that too far, the step to it counts as so much faster, the next one as slower: an
  /// error would swing from step to step for ever. Over two steps these swings cancel.
  /// Zero before two steps in a row were learned.
  [[nodiscard]] Twist recent() const;
  /// The robot moved so within `dt_s`. Nothing is learned from times <= 0.
  void learn(const Pose2& motion, double dt_s);
  /// Nothing is known of the motion any more: it is taken to stand still.
  void reset();

 private:
  double max_speed_m_per_s_;
  double max_turn_rate_rad_per_s_;
  double speed_m_per_s_ = 0.0;
  double turn_rate_rad_per_s_ = 0.0;
  double speed_before_m_per_s_ = 0.0;  // of the step before the last
  double turn_rate_before_rad_per_s_ = 0.0;
  int steps_ = 0;                     // learned in a row, 2 at most
  double speed_variance_ = 0.25;      // of the change between two steps, (m/s)^2
  double turn_rate_variance_ = 0.49;  // (rad/s)^2
};

}  // namespace cairn
