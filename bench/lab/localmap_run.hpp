#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/lab/localmap_ablations.hpp"
#include "geometry/pose2.hpp"
#include "sensing/scan_joiner.hpp"

namespace cairn::lab {

/// Where the local layer has the robot at one time, by the motions that it told one after the
/// other.
struct TrackedPose {
  double time_s = 0.0;
  Pose2 T_lpm_robot;
  double travel_m = 0.0;   ///< Along the trajectory, from scan to scan, since the first.
  bool is_of_scan = true;  ///< And not carried on between two scans by odometry.
  int sharing = 1;         ///< How many poses bore this stamp, and became this one.
};

/// A trajectory has one pose at a time. Where a burst of messages bears one stamp, nothing tells
/// which of them was meant: the mean of their poses errs least, that of the scans' own ones where
/// there are any. Sorted by time; of equal stamps the result depends on their order only by
/// rounding.
[[nodiscard]] std::vector<TrackedPose> one_pose_per_stamp(std::vector<TrackedPose> poses);

/// CPU time per scan of one stage.
struct StageTimes {
  std::vector<double> times_ms;

  [[nodiscard]] double mean_ms() const;
  /// @param share 0.5: the median; 1: the longest. 0 without scans.
  [[nodiscard]] double quantile_ms(double share) const;
};

/// What came of the local layer alone on a log.
struct LocalmapRun {
  std::vector<TrackedPose> track;  ///< At every scan, in the order of the log.
  /// The same, and between two scans at every sample of odometry: its way bent to end at the fix.
  /// In the order of time, one pose per stamp.
  std::vector<TrackedPose> poses;
  std::vector<Vector2d> walls_lpm;             ///< Some of the returns, where the map took them up.
  std::map<std::string, std::int64_t> notes;   ///< How the fixes came about.
  std::map<std::string, std::int64_t> faults;  ///< Scans at which odometry disagreed, by reason.
  std::int64_t refused = 0;
  std::int64_t restarts = 0;
  std::int64_t renewals = 0;
  double scan_lag_s = 0.0;
  std::int64_t degenerate = 0;
  std::size_t map_bytes = 0;
  StageTimes matching;
  StageTimes insertion;
  StageTimes other;  ///< Reading messages, joining scans and odometry.
  StageTimes all;
  JoinerCounters joiner;
  std::int64_t refused_messages = 0;  ///< By their content: they are not among the scans.
  std::string last_refusal;           ///< Why the last of them; empty: none.
  std::int64_t laser_changes = 0;     ///< Of a laser's beams or view.
  std::string damage;                 ///< What is wrong with the log; empty where all is well.

  [[nodiscard]] double travel_m() const { return track.empty() ? 0.0 : track.back().travel_m; }
};

/// The daemon's options: the defaults where no file is named. Throws clients::Failure(kBadData).
[[nodiscard]] DaemonOptions options_from_file(const std::string& config_file);

/// Runs joiner and local mapper over a log, nothing else. Throws clients::Failure(kBadData) where
/// there is no log, or no scan in it.
[[nodiscard]] LocalmapRun run_localmap(const std::string& log, const LocalmapSetup& setup);

}  // namespace cairn::lab
