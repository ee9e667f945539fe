#include "lpm/motion_watch.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

enum Component : int { kDrive, kSlide, kTurn };

constexpr double kLeastTimeStep_s = 1.0;  // recorded stamps are not to be trusted below this
constexpr double kStill = 1e-9;           // odometry that repeats itself, but for rounding
constexpr double kDriving_m = 0.01;       // per step
constexpr double kDriving_rad = 0.01;     // per step
constexpr int kRepeats = 2;               // so many in a row are no chance
constexpr double kAlong = 4.0;            // times as far ahead as sideways: driven, not carried
constexpr double kDroveOn_m = 0.5;        // by the scans, while odometry stood
constexpr double kGoesOn = 0.25;    // share of the mean disagreement that the newest step must have
constexpr double kOpposite = -0.6;  // correlation
constexpr double kMemory = 2.0;     // of agreement, in travels that convict
constexpr double kVague_m = 0.1;    // sigma of a match that says nothing of its own
constexpr double kVague_rad = 0.1;

Eigen::Vector3d components_of(const Pose2& motion) {
  const Vector2d along = Pose2(0.0, 0.0, -0.5 * motion.theta()) * motion.translation();
  return {along.x(), along.y(), motion.theta()};
}

/// Variances of drive, slide and turn of a motion.
Eigen::Vector3d variances_of(const GaussianPose& motion) {
  const double c = std::cos(0.5 * motion.mean.theta());
  const double s = std::sin(0.5 * motion.mean.theta());
  const Matrix3d& p = motion.covariance;
  const double cross = 2.0 * c * s * p(0, 1);
  return {c * c * p(0, 0) + cross + s * s * p(1, 1), s * s * p(0, 0) - cross + c * c * p(1, 1),
          p(2, 2)};
}

}  // namespace

std::string_view to_string(MotionFault fault) {
  switch (fault) {
    case MotionFault::kNone:
      return "none";
    case MotionFault::kSlip:
      return "slip";
    case MotionFault::kCarried:
      return "carried";
    case MotionFault::kOdometryStalled:
      return "odometry stalled";
    case MotionFault::kScanStalled:
      return "scan stalled";
    case MotionFault::kBump:
      return "bump";
    case MotionFault::kTeleport:
      return "teleport";
    case MotionFault::kLaserReversed:
      return "laser reversed";
    case MotionFault::kLaserUpsideDown:
      return "laser upside down";
  }
  return "unknown";
}

Status validate(const MotionWatchOptions& options) {
  return Validator("lpm.motion_watch")
      .positive("max_speed_m_per_s", options.max_speed_m_per_s)
      .positive("max_turn_rate_rad_per_s", options.max_turn_rate_rad_per_s)
      .within("window_steps", options.window_steps, 1, 100)
      .within("alarm_sigmas", options.alarm_sigmas, 3.0, 100.0)
      .positive("least_m", options.least_m)
      .positive("least_rad", options.least_rad)
      .positive("flip_travel_m", options.flip_travel_m)
      .positive("flip_turn_rad", options.flip_turn_rad)
      .status();
}

MotionWatch::MotionWatch(const MotionWatchOptions& options) : options_(options) {
  CAIRN_CHECK(validate(options).ok());
  window_.reserve(static_cast<std::size_t>(options.window_steps));
}

void MotionWatch::Agreement::add(double odometry_part, double matched_part, double memory) {
  const double keep = std::exp(-std::abs(odometry_part) / memory);
  product = keep * product + odometry_part * matched_part;
  odometry = keep * odometry + odometry_part * odometry_part;
  matched = keep * matched + matched_part * matched_part;
  travel = keep * travel + std::abs(odometry_part);
}

bool MotionWatch::Agreement::is_opposite(double least_travel) const {
  return travel >= least_travel && product < kOpposite * std::sqrt(odometry * matched) &&
         matched > 0.25 * odometry;
}

bool MotionWatch::is_impossible(const MotionEvidence& evidence) const {
  const double possible_s = std::max(std::abs(evidence.dt_s), kLeastTimeStep_s);
  const Pose2& step = evidence.odometry_step;
  return step.translation().norm() > options_.max_speed_m_per_s * possible_s ||
         std::abs(step.theta()) > options_.max_turn_rate_rad_per_s * possible_s;
}

void MotionWatch::interrupt() {
  window_.clear();
  frozen_steps_ = 0;
  frozen_travel_m_ = 0.0;
  was_driving_ = false;
  repeated_scans_ = 0;
  repeated_odometry_.setZero();
}

MotionFault MotionWatch::judge(const MotionEvidence& evidence) {
  if (is_impossible(evidence)) {
    interrupt();
    return MotionFault::kTeleport;
  }
  Step step;
  step.odometry = components_of(evidence.odometry_step);
  step.matched = components_of(evidence.matched.mean);
  step.error = step.matched - components_of(evidence.predicted.mean);
  step.error.z() = wrap_angle(step.error.z());
  step.variance = variances_of(evidence.predicted);
  step.match_variance = variances_of(evidence.matched);
  note_repeats(step, evidence.is_scan_repeated);
  note_agreement(step);
  const MotionFault sudden = sudden_fault(step);  // against what went before
  if (window_.size() >= static_cast<std::size_t>(options_.window_steps)) {
    window_.erase(window_.begin());
  }
  window_.push_back(step);
  if (repeated_scans_ >= kRepeats && (repeated_odometry_.head<2>().norm() >= options_.least_m ||
                                      std::abs(repeated_odometry_.z()) >= options_.least_rad)) {
    return MotionFault::kScanStalled;
  }
  const MotionFault flip = flip_fault();
  if (flip != MotionFault::kNone) {
    return flip;
  }
  return sudden != MotionFault::kNone ? sudden : lasting_fault();
}

void MotionWatch::note_repeats(const Step& step, bool is_scan_repeated) {
  if (step.odometry.cwiseAbs().maxCoeff() < kStill) {
    ++frozen_steps_;
    frozen_travel_m_ += step.matched[kDrive];
  } else {
    frozen_steps_ = 0;
    frozen_travel_m_ = 0.0;
    was_driving_ = std::abs(step.odometry[kDrive]) > kDriving_m ||
                   std::abs(step.odometry[kTurn]) > kDriving_rad;
  }
  repeated_scans_ = is_scan_repeated ? repeated_scans_ + 1 : 0;
  repeated_odometry_ = is_scan_repeated ? Eigen::Vector3d(repeated_odometry_ + step.odometry)
                                        : Eigen::Vector3d::Zero();
}

void MotionWatch::note_agreement(const Step& step) {
  if (step.match_variance[kDrive] < kVague_m * kVague_m) {
    drive_.add(step.odometry[kDrive], step.matched[kDrive], kMemory * options_.flip_travel_m);
  }
  if (step.match_variance[kTurn] < kVague_rad * kVague_rad) {
    turn_.add(step.odometry[kTurn], step.matched[kTurn], kMemory * options_.flip_turn_rad);
  }
}

MotionFault MotionWatch::flip_fault() const {
  if (drive_.is_opposite(options_.flip_travel_m)) {
    return MotionFault::kLaserReversed;
  }
  return turn_.is_opposite(options_.flip_turn_rad) ? MotionFault::kLaserUpsideDown
                                                   : MotionFault::kNone;
}

double MotionWatch::alarm(const Step& sum, int component, double lag) const {
  const double least = component == kTurn ? options_.least_rad : options_.least_m;
  const double sigma = std::sqrt(sum.variance[component] + sum.match_variance[component]);
  return std::max(0.0, std::abs(sum.error[component]) - lag) /
         std::max(least, options_.alarm_sigmas * sigma);
}

double MotionWatch::largest_step(int component) const {
  double largest = 0.0;
  for (const Step& step : window_) {
    largest =
        std::max({largest, std::abs(step.odometry[component]), std::abs(step.matched[component])});
  }
  return largest;
}

MotionWatch::Step MotionWatch::windowed() const {
  Step sum;
  for (const Step& step : window_) {
    sum.odometry += step.odometry;
    sum.matched += step.matched;
    sum.error += step.error;
    sum.variance += step.variance;
    sum.match_variance += step.match_variance;
  }
  // A motion hangs between two matches, however many lie between them.
  sum.match_variance *= 2.0 / static_cast<double>(std::max<std::size_t>(window_.size(), 1));
  return sum;
}

MotionFault MotionWatch::sudden_fault(const Step& step) const {
  const Step before = windowed();
  Step alone = step;
  alone.match_variance *= 2.0;
  for (const int component : {kSlide, kTurn}) {
    const bool is_more = std::abs(step.matched[component]) > std::abs(step.odometry[component]);
    const double lag = std::max(largest_step(component), std::abs(step.odometry[component]));
    if (is_more && alarm(alone, component, lag) > 1.0 && alarm(before, component, 0.0) < kGoesOn) {
      return MotionFault::kBump;
    }
  }
  return MotionFault::kNone;
}

MotionFault MotionWatch::lasting_fault() const {
  const Step sum = windowed();
  const auto alarm_of = [&](int component) {
    return alarm(sum, component, largest_step(component));
  };
  int worst = kDrive;
  for (const int component : {kSlide, kTurn}) {
    worst = alarm_of(component) > alarm_of(worst) ? component : worst;
  }
  const double mean_error = sum.error[worst] / static_cast<double>(window_.size());
  const bool goes_on = window_.back().error[worst] * mean_error > kGoesOn * mean_error * mean_error;
  if (alarm_of(worst) <= 1.0 || !goes_on) {
    return MotionFault::kNone;
  }
  if (frozen_steps_ >= kRepeats && was_driving_ && worst != kSlide) {
    return MotionFault::kOdometryStalled;
  }
  // Nobody carries a robot for long as if it drove.
  if (frozen_steps_ >= options_.window_steps && std::abs(frozen_travel_m_) >= kDroveOn_m &&
      std::abs(sum.matched[kDrive]) > kAlong * std::abs(sum.matched[kSlide])) {
    return MotionFault::kOdometryStalled;
  }
  return std::abs(sum.matched[worst]) < std::abs(sum.odometry[worst]) ? MotionFault::kSlip
                                                                      : MotionFault::kCarried;
}

}  // namespace cairn
