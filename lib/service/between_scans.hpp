#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "sensing/odometry.hpp"

namespace cairn {

/// Keeps the odometry that comes between two scans, so that the robot's pose can be told at each of
/// its stamps and not at the scans' only. Bounded: of more than kMost samples the oldest go.
class BetweenScans {
 public:
  static constexpr std::size_t kMost = 2000;

  void add(const OdometrySample& sample);

  /// What came since the last call and belongs before this scan; see PerceivedScan::between.
  /// @param T_odom_robot the scan's own odometry, if it has any
  std::vector<OdometrySample> take(TimePoint scan_time, const std::optional<Pose2>& T_odom_robot);

 private:
  [[nodiscard]] std::size_t count_before(TimePoint scan_time, const Pose2& T_odom_robot) const;

  std::deque<OdometrySample> samples_;  ///< In the order of arrival.
  std::optional<Pose2> T_odom_previous_;
};

}  // namespace cairn
