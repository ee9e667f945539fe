#include "lpm/localisation_watch.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "base/check.hpp"

namespace cairn {
namespace {

constexpr double kMostPerMessage_s = 1.0;  // of silence: a longer step is the clock's

constexpr double kUsualGain = 0.1;  // of the usual silence, per message
constexpr double kUnusual = 4.0;    // times as long as usual is not usual

/// Of a point one metre from the robot's centre, where it is the largest.
double variance_m2(const Matrix3d& covariance) {
  const Eigen::Matrix2d translation = covariance.topLeftCorner<2, 2>();
  const auto spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(translation).eigenvalues();
  return spread.y() + covariance(2, 2);
}

}  // namespace

void Silence::heard() {
  usual_s_ += kUsualGain * (silent_s_ - usual_s_);
  silent_s_ = 0.0;
}

void Silence::other_heard(TimePoint time) {
  if (last_) {
    silent_s_ += std::clamp(seconds_between(*last_, time), 0.0, kMostPerMessage_s);
  }
  last_ = time;
}

LocalisationWatch::LocalisationWatch(const LocalisationOptions& options) : options_(options) {
  CAIRN_CHECK(validate(options).ok());
  calm_scans_.fill(options.calm_scans);
}

void LocalisationWatch::heard_odometry(TimePoint time) {
  odometry_silence_.heard();
  scan_silence_.other_heard(time);
  health_.had_odometry = true;
  health_.no_odometry_s = 0.0;
  health_.no_scans_s = scan_silence_.seconds();
  if (health_.state != LocalisationState::kStarting && are_scans_missing()) {
    judge();
  }
}

void LocalisationWatch::heard_scan(TimePoint time) {
  scan_silence_.heard();
  odometry_silence_.other_heard(time);
  health_.no_scans_s = 0.0;
  health_.no_odometry_s = odometry_silence_.seconds();
}

void LocalisationWatch::observe(const LocalFix& fix, bool has_odometry) {
  health_.uses_odometry = has_odometry;
  guessed_scans_ = has_odometry ? 0 : guessed_scans_ + 1;
  doubt(fix);
  accumulate(fix);
  count_runs(fix);
  note_fault(fix.fault);
  fix_ = fix;
  judge();
  if (is_lost_ && !is_map_new_) {
    ++health_.scans_not_mapped;
  }
}

void LocalisationWatch::doubt(const LocalFix& fix) {
  const bool was_moved = fix.note == FixNote::kContradiction || fix.fault == MotionFault::kBump ||
                         fix.fault == MotionFault::kCarried;
  through_walls_ = fix.through_walls.value_or(through_walls_);
  const double worth = fix.score - through_walls_;
  const bool is_worse = worth < usual_score_ - options_.doubt_drop;
  if (was_moved && is_worse) {
    is_doubted_ = true;
  }
  trusted_scans_ = is_doubted_ && fix.is_matched && !is_worse ? trusted_scans_ + 1 : 0;
  is_doubted_ = is_doubted_ && trusted_scans_ < options_.patience_scans;
  is_doubtful_ = is_doubted_ && fix.is_matched;
  if (fix.is_matched && !is_doubted_) {
    usual_score_ += (usual_score_ > 0.0 ? kUsualGain : 1.0) * (worth - usual_score_);
  }
}

void LocalisationWatch::accumulate(const LocalFix& fix) {
  if (fix_) {
    since_reliable_ = compounded(since_reliable_, fix.motion);
  }
  if (fix.note == FixNote::kFirst || (fix.is_matched && !fix.is_degenerate && !is_doubtful_)) {
    since_reliable_ = {};
    reliable_m2_ = variance_m2(fix.covariance);
  }
  health_.error_m = std::sqrt(reliable_m2_ + variance_m2(since_reliable_.covariance));
}

void LocalisationWatch::count_runs(const LocalFix& fix) {
  refused_scans_ = is_refused(fix.note) ? refused_scans_ + 1 : 0;
  matched_scans_ = fix.is_matched && !is_doubtful_ ? matched_scans_ + 1 : 0;
  if (fix.note != FixNote::kBlockedSensor) {
    unfitting_scans_ = is_refused(fix.note) || is_doubtful_ ? unfitting_scans_ + 1 : 0;
  }
}

void LocalisationWatch::note_fault(MotionFault fault) {
  health_.fault = MotionFault::kNone;
  for (std::size_t i = 1; i < calm_scans_.size(); ++i) {
    const bool was_calm = calm_scans_[i] == options_.calm_scans;
    const bool is_told = fault == static_cast<MotionFault>(i);
    calm_scans_[i] = is_told ? 0 : std::min(calm_scans_[i] + 1, options_.calm_scans);
    health_.fault_counts[i] += is_told && was_calm ? 1 : 0;
    if (calm_scans_[i] < options_.calm_scans) {
      health_.fault = static_cast<MotionFault>(i);  // the last one is the gravest
    }
  }
}

bool LocalisationWatch::needs_new_map() const {
  return (is_lost_ || is_doubtful_) && unfitting_scans_ >= options_.new_map_scans &&
         fix_->note != FixNote::kBlockedSensor;
}

bool LocalisationWatch::are_scans_missing() const {
  return health_.no_scans_s > std::max(options_.silence_s, kUnusual * scan_silence_.usual_s());
}

LocalisationCause LocalisationWatch::cause_of_trouble() const {
  if (are_scans_missing()) {
    return LocalisationCause::kNoScans;
  }
  if (refused_scans_ >= options_.patience_scans) {
    return fix_->note == FixNote::kBlockedSensor ? LocalisationCause::kBlockedSensor
                                                 : LocalisationCause::kNotMatched;
  }
  if (is_doubtful_) {
    return LocalisationCause::kDoubt;
  }
  if (health_.error_m > options_.error_min_m) {
    return LocalisationCause::kErrorGrown;
  }
  if (health_.fault != MotionFault::kNone) {
    return LocalisationCause::kFault;
  }
  return guessed_scans_ >= options_.patience_scans ? LocalisationCause::kNoOdometry
                                                   : LocalisationCause::kNone;
}

void LocalisationWatch::judge() {
  const LocalisationCause trouble = cause_of_trouble();
  good_scans_ = trouble == LocalisationCause::kNone ? good_scans_ + 1 : 0;
  health_.is_over = trouble == LocalisationCause::kNone;
  if (health_.error_m > options_.error_max_m) {
    lose(trouble);
  } else if (is_lost_ && health_.error_m < options_.error_min_m &&
             matched_scans_ >= options_.found_scans) {
    is_lost_ = false;
    is_map_new_ = false;
  }
  if (is_lost_) {
    good_scans_ = 0;
    health_.state = LocalisationState::kLost;
  } else if (trouble != LocalisationCause::kNone) {
    health_.state = LocalisationState::kDegraded;
    health_.cause = trouble;
  } else if (health_.state == LocalisationState::kStarting || good_scans_ >= options_.calm_scans ||
             health_.cause == LocalisationCause::kFault) {
    // A fault has been in force until now for as long.
    health_.state = LocalisationState::kTracking;
    health_.cause = LocalisationCause::kNone;
  } else if (health_.state == LocalisationState::kLost) {
    health_.state = LocalisationState::kDegraded;
  }
}

void LocalisationWatch::lose(LocalisationCause cause) {
  if (!is_lost_ || is_map_new_) {
    health_.cause = cause;
  }
  health_.times_lost += is_lost_ ? 0 : 1;
  is_lost_ = true;
  is_map_new_ = false;
}

void LocalisationWatch::started_new_map() {
  lose(LocalisationCause::kNewMap);
  is_map_new_ = true;
  since_reliable_ = {};
  reliable_m2_ = 0.0;
  refused_scans_ = 0;
  unfitting_scans_ = 0;
  matched_scans_ = 0;
  good_scans_ = 0;
  usual_score_ = 0.0;
  through_walls_ = 0.0;
  is_doubted_ = false;
  is_doubtful_ = false;
  health_.error_m = 0.0;
  health_.state = LocalisationState::kLost;
  health_.cause = LocalisationCause::kNewMap;
  health_.is_over = false;
}

}  // namespace cairn
