#include "lpm/localisation_health.hpp"

#include <cstdio>
#include <tuple>

#include "base/validator.hpp"

namespace cairn {
namespace {

std::string fixed(double value, const char* unit) {
  std::array<char, 48> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.1f %s", value, unit));
  return text.data();
}

std::string span_text(double seconds) {
  return seconds > 0.0 ? fixed(seconds, "s") : "a while";
}

std::string fault_text(MotionFault fault) {
  return std::string(to_string(fault)) + ": " + std::string(advice_for(fault));
}

std::string cause_text(const LocalisationHealth& health, const LocalisationOptions& options) {
  const std::string error = "estimated error " + fixed(health.error_m, "m") + ", lost above " +
                            fixed(options.error_max_m, "m") + ", found below " +
                            fixed(options.error_min_m, "m");
  const bool is_lost = health.state == LocalisationState::kLost;
  switch (health.cause) {
    case LocalisationCause::kNone:
      return "";
    case LocalisationCause::kNewMap:
      return "nothing fitted the local map any more: a new one was started, and how it lies to the "
             "old one is not known";
    case LocalisationCause::kErrorGrown:
      return "no reliable fix for a while: " + error;
    case LocalisationCause::kNoScans:
      return "no scan for " + span_text(health.no_scans_s) + ": odometry alone";
    case LocalisationCause::kBlockedSensor:
      return "hardly a return in the scans: is the laser covered, or nothing within its range? " +
             (is_lost ? error : "odometry alone meanwhile");
    case LocalisationCause::kNotMatched:
      return "the scans do not fit the local map: was the robot carried, or much moved around "
             "it? " +
             (is_lost ? error : "odometry alone meanwhile");
    case LocalisationCause::kDoubt:
      return "the scans fit the local map less well than before something moved the robot: nothing "
             "is mapped until it is clear where it is";
    case LocalisationCause::kFault:
      return fault_text(health.fault);
    case LocalisationCause::kNoOdometry:
      return "no odometry" +
             (health.had_odometry ? " for " + span_text(health.no_odometry_s) : std::string()) +
             ": the robot is taken to go on as it went, corrected by the scans";
  }
  return "";
}

}  // namespace

Status validate(const LocalisationOptions& options) {
  return Validator("localisation")
      .within("error_min_m", options.error_min_m, 0.01, 0.9)
      .within("error_max_m", options.error_max_m, 0.3, 100.0)
      .require("error_max_m", options.error_max_m > options.error_min_m,
               "be greater than error_min_m")
      .within("patience_scans", options.patience_scans, 1, 1000)
      .within("calm_scans", options.calm_scans, 1, 1000)
      .within("found_scans", options.found_scans, 1, 1000)
      .within("new_map_scans", options.new_map_scans, 1, 100'000)
      .within("doubt_drop", options.doubt_drop, 0.01, 1.0)
      .positive("silence_s", options.silence_s)
      .within("unknown_way_m", options.unknown_way_m, 4.0, 1000.0)
      .positive("unknown_turn_rad", options.unknown_turn_rad)
      .status();
}

std::string_view to_string(LocalisationState state) {
  switch (state) {
    case LocalisationState::kStarting:
      return "starting";
    case LocalisationState::kTracking:
      return "tracking";
    case LocalisationState::kDegraded:
      return "degraded";
    case LocalisationState::kLost:
      return "lost";
  }
  return "unknown";
}

std::string_view to_string(LocalisationCause cause) {
  switch (cause) {
    case LocalisationCause::kNone:
      return "none";
    case LocalisationCause::kNewMap:
      return "new local map";
    case LocalisationCause::kErrorGrown:
      return "error grown";
    case LocalisationCause::kNoScans:
      return "no scans";
    case LocalisationCause::kBlockedSensor:
      return "blocked sensor";
    case LocalisationCause::kNotMatched:
      return "not matched";
    case LocalisationCause::kDoubt:
      return "doubtful match";
    case LocalisationCause::kFault:
      return "fault";
    case LocalisationCause::kNoOdometry:
      return "no odometry";
  }
  return "unknown";
}

bool is_alike(const LocalisationHealth& a, const LocalisationHealth& b) {
  const auto key = [](const LocalisationHealth& health) {
    return std::tuple(health.state, health.cause, health.fault, health.times_lost);
  };
  return key(a) == key(b);
}

std::string_view advice_for(MotionFault fault) {
  switch (fault) {
    case MotionFault::kNone:
      return "";
    case MotionFault::kSlip:
      return "the wheels say more than the scans: they spin, or the robot pushes against something";
    case MotionFault::kCarried:
      return "the scans say more than the wheels: the robot was lifted, pushed, or slides";
    case MotionFault::kOdometryStalled:
      return "odometry stands still while the scans move: check its source";
    case MotionFault::kScanStalled:
      return "the laser repeats one scan while the wheels drive: check its driver";
    case MotionFault::kBump:
      return "the robot was moved sideways or turned all at once";
    case MotionFault::kTeleport:
      return "odometry jumped farther than the robot can drive; the jump is not believed";
    case MotionFault::kLaserReversed:
      return "the laser looks backward: check the mounting pose, theta_rad is off by about pi, or "
             "odometry counts backward";
    case MotionFault::kLaserUpsideDown:
      return "the laser turns the wrong way round: it hangs upside down, check its mounting and "
             "theta_sign, or odometry turns the wrong way";
  }
  return "";
}

std::string reason_of(const LocalisationHealth& health, const LocalisationOptions& options) {
  if (health.state == LocalisationState::kStarting) {
    return "no scan has come yet";
  }
  const std::string text = cause_text(health, options);
  return health.is_over && !text.empty() ? "until just now: " + text : text;
}

}  // namespace cairn
