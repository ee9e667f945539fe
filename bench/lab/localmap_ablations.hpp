#pragma once

#include <string>

#include "runtime/daemon_options.hpp"

namespace cairn::lab {

/// What `cairn-lab localmap` runs, and how.
struct LocalmapSetup {
  DaemonOptions options;
  bool compensates_motion = true;  ///< Off: every sweep counts as taken in no time.
};

/// Leaves a part of the local layer out, to see what it is worth:
///  - "wall-orientation": lpm.wall_orientation.enabled is false;
///  - "motion-learning": lpm.motion.learns is false;
///  - "motion-compensation": sweeps count as taken in no time;
///  - "degeneracy-handling": odometry does not hold the robot where returns do not: in least
///  squares
///    it counts as uncertain by 1 m and 1 rad.
///
/// Throws clients::Failure(kUsage) for any other name.
void leave_out(const std::string& part, LocalmapSetup* setup);

}  // namespace cairn::lab
