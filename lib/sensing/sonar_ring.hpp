#pragma once

#include <vector>

#include "geometry/pose2.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// One reading of every sensor of a sonar ring.
struct SonarRing {
  TimePoint time;
  std::vector<Pose2> T_robot_sensor;  ///< Axis of each cone along the sensor's x.
  std::vector<float> ranges_m;        ///< As many; +infinity: no echo, NaN: no statement.
};

}  // namespace cairn
