#include "lpm/way_watch.hpp"

#include <algorithm>
#include <cmath>

#include "lpm/scan_continuity.hpp"

namespace cairn {
namespace {

constexpr double kGoesOn = 0.65;    // of returns: the surroundings are those of before
constexpr double kBreaksOff = 0.6;  // of returns, looked at closely and both ways: less is a break
constexpr double kWorse = 0.15;     // less in score than usual
constexpr double kShowing_m = 3.0;  // of travel that shows another view,
constexpr double kShowing_rad = kPi;  // or of turns
constexpr double kStep_m = 0.5;       // after which a scan sees what the one before saw
constexpr double kStep_rad = 0.5;
constexpr double kBump_m = 0.6;  // off odometry: more is no bump
constexpr double kBump_rad = 0.6;

bool is_within(const Pose2& motion, double most_m, double most_rad) {
  return motion.translation().norm() <= most_m && std::abs(motion.theta()) <= most_rad;
}

}  // namespace

void WayWatch::foretell(const Pose2& step) {
  for (auto& [laser, seen] : seen_) {
    seen.T_robot_foretold = seen.T_robot_foretold * step;
  }
}

bool WayWatch::is_in_doubt(const LocalFix& fix, double usual_score) const {
  return has_broken_off_ || fix.note != FixNote::kMatched || fix.score < usual_score - kWorse ||
         fix.fault == MotionFault::kBump || fix.fault == MotionFault::kCarried;
}

void WayWatch::note(const Circumstances& circumstances,
                    const ScanBeams& beams,
                    const LocalFix& fix) {
  const auto [entry, is_first] = seen_.try_emplace(circumstances.laser);
  Seen& seen = entry->second;
  if (!has_broken_off_) {
    unbroken_score_ = circumstances.usual_score;
  }
  if (!is_first && fix.note != FixNote::kFirst && is_in_doubt(fix, circumstances.usual_score) &&
      breaks_off(seen, beams, fix)) {
    has_broken_off_ = true;
    confirmed_m_ = 0.0;
  } else if (has_broken_off_) {
    confirm(fix);
  }
  const auto goes_on = [&] {
    return is_known_ && circumstances.has_odometry &&
           continuity(beams, seen.returns, seen.T_lpm_robot.inverse() * fix.T_lpm_robot) >= kGoesOn;
  };
  is_known_ = !has_broken_off_ && (!is_refused(fix.note) || goes_on());
  T_lpm_robot_ = fix.T_lpm_robot;
  seen.T_lpm_robot = fix.T_lpm_robot;
  seen.T_robot_foretold = Pose2();
  seen.returns.resize(beams.returns().size());
  std::transform(beams.returns().begin(), beams.returns().end(), seen.returns.begin(),
                 [](const SurfacePoint& point) { return point.p; });
}

/// After a long step between two scans there is no telling.
bool WayWatch::breaks_off(const Seen& seen, const ScanBeams& beams, const LocalFix& fix) const {
  if (!is_within(seen.T_robot_foretold, kStep_m, kStep_rad) ||
      mutual_continuity(beams, seen.returns, seen.T_robot_foretold) >= kBreaksOff) {
    return false;
  }
  // A bump is no break: the match says how the robot was moved.
  const Pose2 matched = seen.T_lpm_robot.inverse() * fix.T_lpm_robot;
  return !fix.is_matched ||
         !is_within(seen.T_robot_foretold.inverse() * matched, kBump_m, kBump_rad) ||
         mutual_continuity(beams, seen.returns, matched) < kBreaksOff;
}

void WayWatch::confirm(const LocalFix& fix) {
  if (!fix.is_matched || fix.score < unbroken_score_ - kWorse) {
    confirmed_m_ = 0.0;
    return;
  }
  const Pose2 step = T_lpm_robot_.inverse() * fix.T_lpm_robot;
  confirmed_m_ += step.translation().norm() + kShowing_m / kShowing_rad * std::abs(step.theta());
  has_broken_off_ = confirmed_m_ < kShowing_m;
}

void WayWatch::start_anew() {
  has_broken_off_ = false;
}

}  // namespace cairn
