#include "bench/lab/localmap_ablations.hpp"

#include "clients/common/failure.hpp"

namespace cairn::lab {

void leave_out(const std::string& part, LocalmapSetup* setup) {
  LpmOptions& lpm = setup->options.service.lpm;
  if (part == "wall-orientation") {
    lpm.wall_orientation.enabled = false;
  } else if (part == "motion-learning") {
    lpm.motion.learns = false;
  } else if (part == "motion-compensation") {
    setup->compensates_motion = false;
  } else if (part == "degeneracy-handling") {
    lpm.motion.least_sigma_m = 1.0;
    lpm.motion.least_sigma_rad = 1.0;
  } else {
    throw clients::Failure(clients::ExitCode::kUsage,
                           "--without " + part +
                               ": one of wall-orientation, motion-learning, motion-compensation, "
                               "degeneracy-handling");
  }
}

}  // namespace cairn::lab
