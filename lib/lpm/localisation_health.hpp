#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "lpm/motion_watch.hpp"

namespace cairn {

/// When the pose in the local map is relied on. In the configuration file: "localisation".
///
/// Source: Simhon and Dudek, IROS 1998: the bounds e_min and e_max of the accumulated error.
struct LocalisationOptions {
  double error_min_m = 0.25;   ///< e_min: with less, the robot knows where it is. [0.01, 0.9]
  double error_max_m = 1.0;    ///< e_max: with more, it is lost. [0.3, 100], > e_min
  int patience_scans = 3;      ///< Refused scans in a row that are worth a word. [1, 1000]
  int calm_scans = 10;         ///< Good scans in a row that end what was said. [1, 1000]
  int found_scans = 5;         ///< Matched scans in a row that a lost robot needs. [1, 1000]
  int new_map_scans = 20;      ///< Refused scans in a row, not for a blocked sensor, after which
                               ///< a lost robot starts a new local map. [1, 100000]
  double doubt_drop = 0.15;    ///< Matched scans are doubted when after a bump, a lift or a refused
                               ///< scan their score is so much less than usual. (0, 1]
  double silence_s = 5.0;      ///< A sensor that says nothing for longer, and longer than usual,
                               ///< has fallen out. > 0
  double unknown_way_m = 5.0;  ///< Sigma of the way from the old local map to a new one.
                               ///< [4, 1000]
  double unknown_turn_rad = 1.5;  ///< Sigma of the turn from the old local map to a new one. > 0
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const LocalisationOptions& options);

/// How far the pose in the local map is to be relied on.
enum class LocalisationState : std::uint8_t {
  kStarting,  ///< No scan has come yet.
  kTracking,  ///< The robot knows where it is.
  kDegraded,  ///< It does, but something is wrong.
  kLost,      ///< It does not. The map takes up nothing, no place is seen.
};

/// The name of a state, as in "tracking".
[[nodiscard]] std::string_view to_string(LocalisationState state);

/// Why a robot is not simply tracking, the gravest first.
enum class LocalisationCause : std::uint8_t {
  kNone,
  kNewMap,         ///< Nothing fitted the local map any more, so another one was started.
  kErrorGrown,     ///< The accumulated error is greater than e_max, or than e_min while not lost.
  kNoScans,        ///< Odometry comes, scans do not.
  kBlockedSensor,  ///< Scans come, with hardly a return in them.
  kNotMatched,     ///< Scans do not fit the local map.
  kDoubt,          ///< They fit it less well than before, since the robot was bumped or carried.
  kFault,          ///< Odometry and scans disagree; see LocalisationHealth::fault.
  kNoOdometry,     ///< Scans come, odometry does not: the robot is taken to go on as it went.
};

/// The name of a cause, as in "blocked sensor".
[[nodiscard]] std::string_view to_string(LocalisationCause cause);

/// How the robot's localisation fares, as of the last reading.
struct LocalisationHealth {
  static constexpr std::size_t kFaults = 9;  ///< Values of MotionFault, kNone included.

  LocalisationState state = LocalisationState::kStarting;
  LocalisationCause cause = LocalisationCause::kNone;
  bool is_over = false;  ///< The cause has gone, but for too short a time to be forgotten.
  MotionFault fault = MotionFault::kNone;  ///< In force, until so many good scans have come.
  /// Estimate of the accumulated error since the last reliable fix: the largest sigma of a point
  /// one metre from the robot's centre.
  double error_m = 0.0;
  bool uses_odometry = false;  ///< For the last scan; else constant velocity was assumed.
  bool had_odometry = false;   ///< Ever.
  double no_odometry_s = 0.0;  ///< For so long scans have come, but no odometry.
  double no_scans_s = 0.0;     ///< For so long odometry has come, but no scan.
  std::array<std::int64_t, kFaults> fault_counts{};  ///< How often each began, by MotionFault.
  std::int64_t times_lost = 0;
  std::int64_t scans_not_mapped = 0;  ///< Taken while lost: kept, but no map took them up.

  [[nodiscard]] std::int64_t count(MotionFault of) const {
    return fault_counts[static_cast<std::size_t>(of)];
  }
};

/// Whether both say the same but for numbers that go on: no news.
[[nodiscard]] bool is_alike(const LocalisationHealth& a, const LocalisationHealth& b);

/// What a fault means and what a person can do about it; empty for kNone.
[[nodiscard]] std::string_view advice_for(MotionFault fault);

/// Why the state is what it is, for people; empty while tracking.
[[nodiscard]] std::string reason_of(const LocalisationHealth& health,
                                    const LocalisationOptions& options);

}  // namespace cairn
