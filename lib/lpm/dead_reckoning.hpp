#pragma once

#include <optional>
#include <vector>

#include "lpm/constant_velocity.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/motion_model.hpp"
#include "lpm/motion_watch.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/scan_lag.hpp"
#include "sensing/scan_joiner.hpp"

namespace cairn {

/// What is known of the robot's motion from one scan to the next before they are matched: from
/// odometry, as far as it has earned belief, else from going on as before. Learns from the matches.
///
/// For every scan after the first, in turn: begin(), predicted() and continued(), end().
class DeadReckoning {
 public:
  /// @pre both options are within their ranges
  DeadReckoning(const MotionOptions& options, const MotionWatchOptions& watch);

  /// The robot is where the scan was taken; steps begin there.
  void start(TimePoint time, const std::optional<Pose2>& T_odom_robot);

  /// Takes the next scan.
  void begin(const JoinedScan& joined);
  /// How the robot moves during the scan, by odometry; without any, as it moved of late by matches.
  /// Unmoved where odometry is not to be believed.
  [[nodiscard]] Twist twist() const;
  /// The step to the scan, wide enough to match from. The covariance is positive definite.
  [[nodiscard]] GaussianPose predicted() const;
  /// The same without odometry, which may have stalled: the robot goes on as it went.
  [[nodiscard]] GaussianPose continued() const { return widened(velocity_.predict(dt_s_)); }
  /// Odometry jumped farther than the robot can drive.
  [[nodiscard]] bool has_jumped() const { return T_odom_step_ && !is_possible_; }
  /// Odometry tells the step, and the robot can have driven so.
  [[nodiscard]] bool has_odometry() const { return is_possible_; }
  /// The robot has driven, by odometry, while the laser said the same to the last bit.
  [[nodiscard]] bool is_scan_frozen() const;
  [[nodiscard]] double dt_s() const { return dt_s_; }
  /// By how much scans are stamped later than odometry, as far as turns have shown it. >= 0
  [[nodiscard]] double scan_lag_s() const { return lag_.lag_s(); }

  /// Ends the step.
  /// @param matched the step by scan matching, with the covariance of the returns alone; none where
  ///        the scan was not matched
  /// @return why odometry and scan disagree, where they do
  MotionFault end(const std::optional<GaussianPose>& matched);

 private:
  [[nodiscard]] GaussianPose widened(GaussianPose motion) const;
  void take_off_lag();
  void note_repeat(const LaserScan& scan);

  MotionOptions options_;
  MotionWatchOptions limits_;
  MotionModel model_;
  ConstantVelocity velocity_;
  MotionWatch watch_;
  ScanLag lag_;
  TimePoint time_;
  std::optional<Pose2> T_odom_robot_;
  // Of the step under way.
  double dt_s_ = 0.0;
  double detour_m_ = 0.0;  // driven beyond what the step is long
  std::optional<Pose2> T_odom_step_;
  bool is_possible_ = false;
  bool is_scan_repeated_ = false;
  std::vector<float> ranges_m_;  // of the scan taken last
};

}  // namespace cairn
