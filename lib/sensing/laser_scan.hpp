#pragma once

#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// One sweep of a planar range finder, with the meaning of its readings already settled at the
/// inlet, whatever the sensor's own convention was.
///
/// A reading is one of
///  - a finite distance > 0 in metres: something was hit there;
///  - +infinity: nothing within `max_range_m`, the beam is free up to there;
///  - NaN: no statement (invalid, blocked, too close); the beam must be ignored.
struct LaserScan {
  TimePoint time;                   ///< Of the first beam.
  std::vector<float> bearings_rad;  ///< Laser frame: x ahead, y left, counterclockwise.
  std::vector<float> ranges_m;      ///< As many as bearings.
  double max_range_m = 0.0;         ///< > 0
  double sweep_duration_s = 0.0;    ///< From first to last beam; 0 where it is not known.
  Pose2 T_robot_laser;              ///< Mounting pose.
  int laser = 0;                    ///< Which of the robot's lasers.
};

/// What every scan fulfils behind the inlet: 2 to 10,000 beams, as many bearings as ranges, finite
/// bearings that differ and span at most a full turn, max range finite and > 0, no range <= 0, at
/// least one range that is not NaN, a sweep of at most a minute.
[[nodiscard]] Status validate(const LaserScan& scan);

}  // namespace cairn
