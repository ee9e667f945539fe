#pragma once

#include <string>
#include <vector>

#include "bench/lab/localmap_run.hpp"
#include "place/place_detector.hpp"

namespace cairn::lab {

/// How well the walls told a pose, at one look.
struct LookedPose {
  double time_s = 0.0;
  Pose2 T_lpm_robot;
  IslandMeasure island;
};

/// What the place detector made of a log.
struct PlacesRun {
  std::vector<PlaceVisit> visits;
  PlaceDetectorReport report;
  StageTimes perception;
  std::vector<LookedPose> poses;
  std::string damage;  ///< What is wrong with the log; empty where all is well.
};

/// Runs the local layer and the place detector over a log, nothing else. Throws
/// clients::Failure(kBadData) where there is no log, or no scan in it.
[[nodiscard]] PlacesRun run_places(const std::string& log, const DaemonOptions& options);

}  // namespace cairn::lab
