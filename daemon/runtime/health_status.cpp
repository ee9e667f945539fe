#include "runtime/health_status.hpp"

#include <spdlog/spdlog.h>

namespace cairn {

void add_health(const LocalisationHealth& health,
                const LocalisationOptions& options,
                cairn_lcm::status_t* status) {
  status->localisation = static_cast<std::int32_t>(health.state);
  status->localisation_name = to_string(health.state);
  status->localisation_cause = to_string(health.cause);
  status->localisation_reason = reason_of(health, options);
  status->localisation_error_m = health.error_m;
  status->localisation_error_min_m = options.error_min_m;
  status->localisation_error_max_m = options.error_max_m;
  status->times_lost = health.times_lost;
  status->scans_not_mapped = health.scans_not_mapped;
  status->is_using_odometry = health.uses_odometry ? 1 : 0;
  status->no_odometry_s = static_cast<float>(health.no_odometry_s);
  status->no_scans_s = static_cast<float>(health.no_scans_s);
  status->fault = to_string(health.fault);
  status->slips = health.count(MotionFault::kSlip);
  status->carryings = health.count(MotionFault::kCarried);
  status->odometry_stalls = health.count(MotionFault::kOdometryStalled);
  status->scan_stalls = health.count(MotionFault::kScanStalled);
  status->bumps = health.count(MotionFault::kBump);
  status->teleports = health.count(MotionFault::kTeleport);
  status->laser_reversals = health.count(MotionFault::kLaserReversed);
  status->laser_inversions = health.count(MotionFault::kLaserUpsideDown);
}

std::string health_text(const LocalisationHealth& health, const LocalisationOptions& options) {
  const std::string reason = reason_of(health, options);
  return std::string(to_string(health.state)) + (reason.empty() ? "" : ": " + reason);
}

std::string health_code(const LocalisationHealth& health) {
  std::string code(to_string(health.state));
  if (health.cause != LocalisationCause::kNone) {
    code += ", " + std::string(to_string(health.cause));
  }
  if (health.cause == LocalisationCause::kFault) {
    code += ", " + std::string(to_string(health.fault));
  }
  return code;
}

void log_health(const LocalisationHealth& before,
                const LocalisationHealth& after,
                const LocalisationOptions& options) {
  if (is_alike(before, after)) {
    return;
  }
  const bool is_well = after.state == LocalisationState::kTracking;
  spdlog::log(is_well ? spdlog::level::info : spdlog::level::warn, "localisation {}",
              health_text(after, options));
}

}  // namespace cairn
