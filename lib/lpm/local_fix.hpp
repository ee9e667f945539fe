#pragma once

#include <cstdint>

#include "geometry/gaussian_pose.hpp"
#include "lpm/motion_watch.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// What the local layer has to say about how it came to a fix.
enum class FixNote : std::uint8_t {
  kMatched,        ///< The scan agrees with the map and with odometry.
  kFirst,          ///< Nothing to match with: the first scan, or the first after a restart.
  kSlip,           ///< Matched, but odometry says otherwise: slip, push, or a stalled wheel.
  kTeleport,       ///< Matched; odometry jumped farther than the robot can drive.
  kBlockedSensor,  ///< Refused: hardly any returns.
  kNoOverlap,      ///< Refused: hardly any return falls where the map knows anything.
  kContradiction,  ///< Refused: the returns do not fall on the walls of the map.
};

/// The name of a note, as in "no overlap".
[[nodiscard]] const char* to_string(FixNote note);
/// Whether the scan was not matched with the map, though there was one.
[[nodiscard]] bool is_refused(FixNote note);

/// Where the robot is in the local metrical map, after one scan.
struct LocalFix {
  TimePoint time;
  /// In the "lpm" frame: one continuous frame of corrected odometry for the whole life of the
  /// mapper.
  Pose2 T_lpm_robot;
  /// Of the match alone, of (x, y, theta) in the lpm frame, in m^2, m rad and rad^2: positive
  /// definite, long along a corridor. Where the match was refused, that of dead reckoning.
  Matrix3d covariance = Matrix3d::Identity();
  /// T_previous_robot: the robot in the frame of the robot at the fix before. Motions of successive
  /// fixes are to be compounded as independent ones: their covariance is the rate at which dead
  /// reckoning by scan matching drifts. Where walls show that the heading of the lpm frame drifts,
  /// it is corrected here, and here alone: the map stays as it was drawn.
  GaussianPose motion;
  bool is_matched = false;
  bool is_degenerate = false;  ///< The scan does not fix every direction (a corridor, few returns).
  double score = 0.0;  ///< Share of the returns over known cells that fall on walls, [0, 1].
  FixNote note = FixNote::kFirst;
  /// The surroundings broke off, at this scan or some scans ago: see WayWatch. A match may then be
  /// one with a place that looks alike, and beams through walls of the map tell against the score.
  bool has_broken_off = false;
  /// Why odometry and scans disagree, over this step and those before it.
  MotionFault fault = MotionFault::kNone;
};

}  // namespace cairn
