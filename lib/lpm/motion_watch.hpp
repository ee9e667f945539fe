#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"

namespace cairn {

/// Why odometry and scans disagree.
enum class MotionFault : std::uint8_t {
  kNone,             ///< They agree.
  kSlip,             ///< Wheels say more than the scan: they spin, or the robot pushes a wall.
  kCarried,          ///< The scan says more than the wheels: lifted, pushed, sliding.
  kOdometryStalled,  ///< Odometry repeats itself while the scan goes on as before, or as a robot
                     ///< drives.
  kScanStalled,      ///< The scan repeats itself, reading by reading, while the wheels drive.
  kBump,             ///< All at once sideways or around, in one step. If it goes on: carried.
  kTeleport,         ///< Odometry jumped farther than the robot can drive.
  kLaserReversed,    ///< Over some travel the scan says back where the wheels say ahead: the laser
                     ///< looks the other way than its mounting pose says.
  kLaserUpsideDown,  ///< Over some turning the scan says left where the wheels say right: the
                     ///< laser hangs upside down.
};

/// The name of a fault, as in "odometry stalled".
[[nodiscard]] std::string_view to_string(MotionFault fault);

/// From when on a disagreement is a fault. In the configuration file: the object
/// "lpm.motion_watch".
struct MotionWatchOptions {
  double max_speed_m_per_s = 3.0;        ///< Faster odometry is a teleport. > 0
  double max_turn_rate_rad_per_s = 6.0;  ///< Faster odometry is a teleport. > 0
  int window_steps = 8;                  ///< Steps over which slips and lifts add up. [1, 100]
  double alarm_sigmas = 5.0;             ///< Disagreement that is no noise, [3, 100]
  double least_m = 0.08;                 ///< if it is as much as this, > 0
  double least_rad = 0.08;               ///< or this. > 0
  double flip_travel_m = 2.0;            ///< Travel that convicts a reversed laser. > 0
  double flip_turn_rad = 3.0;            ///< Turning that convicts one upside down. > 0
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const MotionWatchOptions& options);

/// One step as wheels and scans have it, each in the frame of the robot before it.
struct MotionEvidence {
  double dt_s = 0.0;
  Pose2 odometry_step;
  GaussianPose predicted;  ///< The motion to expect by this odometry, as MotionModel predicts it.
  GaussianPose matched;    ///< By scan matching, with the covariance of the returns alone.
  bool is_scan_repeated = false;  ///< All ranges are exactly those of the scan before.
};

/// Watches odometry and scan matching disagree, and names the reason. It changes nothing by itself:
/// a laser mounted the wrong way is said, not mended.
///
/// Source: Simhon and Dudek, IROS 1998: the robot must know by a rule when its position is not to
/// be relied on; the reasons are ours.
class MotionWatch {
 public:
  /// @pre validate(options).ok()
  explicit MotionWatch(const MotionWatchOptions& options = {});

  /// @pre both covariances are positive definite
  MotionFault judge(const MotionEvidence& evidence);
  /// A step without a match or without odometry: sums over steps begin anew.
  void interrupt();

 private:
  /// Of a step, in the direction of its mean heading.
  struct Step {
    Eigen::Vector3d odometry = Eigen::Vector3d::Zero();  // drive, slide, turn
    Eigen::Vector3d matched = Eigen::Vector3d::Zero();
    Eigen::Vector3d error = Eigen::Vector3d::Zero();  // matched less predicted
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    Eigen::Vector3d match_variance = Eigen::Vector3d::Zero();
  };
  /// How two ways to tell one motion go together, of late.
  struct Agreement {
    double product = 0.0;
    double odometry = 0.0;
    double matched = 0.0;
    double travel = 0.0;
    void add(double odometry_part, double matched_part, double memory);
    [[nodiscard]] bool is_opposite(double least_travel) const;
  };

  [[nodiscard]] bool is_impossible(const MotionEvidence& evidence) const;
  void note_repeats(const Step& step, bool is_scan_repeated);
  void note_agreement(const Step& step);
  /// How alarming a disagreement is: a fault above 1.
  /// @param lag what is excused: one of the two may lag behind by a step
  [[nodiscard]] double alarm(const Step& sum, int component, double lag) const;
  /// The largest motion of a step of the window.
  [[nodiscard]] double largest_step(int component) const;
  [[nodiscard]] MotionFault sudden_fault(const Step& step) const;
  [[nodiscard]] MotionFault lasting_fault() const;
  [[nodiscard]] MotionFault flip_fault() const;
  [[nodiscard]] Step windowed() const;

  MotionWatchOptions options_;
  std::vector<Step> window_;      // oldest first
  int frozen_steps_ = 0;          // odometry has repeated itself so often
  double frozen_travel_m_ = 0.0;  // ahead, by the scans, during them
  bool was_driving_ = false;      // by odometry, when it froze
  int repeated_scans_ = 0;
  Eigen::Vector3d repeated_odometry_ = Eigen::Vector3d::Zero();  // during them
  Agreement drive_;
  Agreement turn_;
};

}  // namespace cairn
