#include "lpm/local_mapper.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "base/check.hpp"
#include "lpm/match_score.hpp"
#include "lpm/scan_continuity.hpp"

namespace cairn {
namespace {

constexpr double kLeastSigma_m = 1e-4;  // of a pose within the map it was matched to
constexpr double kLeastSigma_rad = 1e-4;
constexpr double kStillSigma_m = 1e-5;  // of a motion, per scan: keeps it positive definite
constexpr double kStillSigma_rad = 1e-5;
constexpr double kMatchSigma_m = 0.005;  // no match is better than this
constexpr double kMatchSigma_rad = 0.001;
constexpr double kBlindSigma_m = 1.0;  // of a match in a direction it says nothing about
constexpr double kBlindSigma_rad = 0.5;
constexpr double kDegenerateSigma_m = 0.10;
constexpr double kDegenerateSigma_rad = 0.03;
constexpr double kMinKnownShare = 0.15;     // of returns over known cells
constexpr double kSlip = 9.0;               // squared Mahalanobis of fix and widened prediction
constexpr double kGoodScore = 0.85;         // a match that leaves no wish for another
constexpr double kLeastOfUsualScore = 0.6;  // a sudden fall below it is a wrong match
constexpr double kClearlyBetter = 0.05;     // in score
constexpr double kUnsure_m = 1.0;
constexpr double kUnsure_rad = 0.2;
constexpr float kCover_m = 0.5F;  // a robot in so little room could not move
constexpr double kCoveredShare = 0.8;
constexpr int kAskEvery = 4;             // scans: what is behind walls changes slowly
constexpr double kGoesOn = 0.65;         // of returns: the surroundings are those of before
constexpr double kRadPerTravel_m = 3.0;  // a turn of 1 rad renews the map as so much travel

Matrix3d diagonal(double sigma_x_m, double sigma_y_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_x_m * sigma_x_m, sigma_y_m * sigma_y_m, sigma_rad * sigma_rad)
      .asDiagonal();
}

/// A covariance in the frame of the parent, turned into the frame that is turned by `angle_rad`.
Matrix3d seen_from(const Matrix3d& covariance, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  Matrix3d turn;
  turn << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  const Matrix3d seen = turn * covariance * turn.transpose();
  return 0.5 * (seen + seen.transpose());
}

Matrix3d match_covariance(const Matrix3d& information) {
  const Matrix3d regular =
      information + diagonal(1.0 / kBlindSigma_m, 1.0 / kBlindSigma_m, 1.0 / kBlindSigma_rad);
  const Matrix3d covariance =
      regular.inverse() + diagonal(kMatchSigma_m, kMatchSigma_m, kMatchSigma_rad);
  return 0.5 * (covariance + covariance.transpose());
}

bool is_degenerate(const Matrix3d& covariance) {
  const Eigen::Matrix2d translation = covariance.topLeftCorner<2, 2>();
  const double largest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(translation).eigenvalues().y();
  return largest > kDegenerateSigma_m * kDegenerateSigma_m ||
         covariance(2, 2) > kDegenerateSigma_rad * kDegenerateSigma_rad;
}

/// Of a way that nothing but odometry tells of.
bool is_unsure(const Matrix3d& covariance) {
  return covariance(0, 0) + covariance(1, 1) > kUnsure_m * kUnsure_m ||
         covariance(2, 2) > kUnsure_rad * kUnsure_rad;
}

}  // namespace

const char* to_string(FixNote note) {
  switch (note) {
    case FixNote::kMatched:
      return "matched";
    case FixNote::kFirst:
      return "first";
    case FixNote::kSlip:
      return "slip";
    case FixNote::kTeleport:
      return "teleport";
    case FixNote::kBlockedSensor:
      return "blocked sensor";
    case FixNote::kNoOverlap:
      return "no overlap";
    case FixNote::kContradiction:
      return "contradiction";
  }
  return "unknown";
}

bool is_refused(FixNote note) {
  return note == FixNote::kBlockedSensor || note == FixNote::kNoOverlap ||
         note == FixNote::kContradiction;
}

LocalMapper::LocalMapper(const LpmOptions& options)
    : options_(options),
      map_(options.map),
      matcher_(options.matcher, options.match, options.particles),
      motion_(options.motion, options.motion_watch),
      wall_orientation_(options.wall_orientation) {
  CAIRN_CHECK(validate(options).ok());
}

LocalFix LocalMapper::absorb(const JoinedScan& joined) {
  const LocalFix fix = locate(joined);
  take_up(fix);
  return fix;
}

LocalFix LocalMapper::locate(const JoinedScan& joined) {
  motion_.begin(joined);
  laser_ = joined.scan.laser;
  beams_.take(joined.scan, motion_.twist(), options_.map.max_free_range_m);
  matcher_.take(beams_);
  LocalFix fix;
  fix.time = joined.scan.time;
  if (!is_started_) {
    fix.T_lpm_robot = T_lpm_robot_;
    fix.covariance = diagonal(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad);
    fix.motion.covariance = fix.covariance;
  } else {
    fix.motion = motion_.predicted();
    const GaussianPose predicted = compounded({T_lpm_robot_, uncertainty_}, fix.motion);
    fix.T_lpm_robot = predicted.mean;
    fix.covariance = predicted.covariance;
    blind_way_m_ += joined.odom_way_m;
    if (is_sensor_blocked()) {
      fix.note = FixNote::kBlockedSensor;
    } else if (blind_way_m_ > options_.map.memory_travel_m) {
      // What the map holds would be forgotten by now: whatever looks like it may be another place.
      // The new map is drawn around the robot; how it lies to the old one is what the motion says.
      clear_map();
      ++(is_unsure(fix.motion.covariance) ? restarts_ : renewals_);
      fix.note = FixNote::kFirst;
      fix.covariance = diagonal(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad);
    } else {
      settle(best_match(predicted), predicted, &fix);
    }
    if (motion_.has_jumped() && fix.is_matched) {
      fix.note = FixNote::kTeleport;
    }
  }
  advance(joined, &fix);
  ask_what_is_behind_walls(&fix);
  note_way(fix);
  correct_heading(&fix);
  return fix;
}

bool LocalMapper::is_sensor_blocked() const {
  const std::vector<float>& ranges_m = beams_.ranges_m();
  const auto near = std::count_if(ranges_m.begin(), ranges_m.end(),
                                  [](float range_m) { return range_m < kCover_m; });
  const auto beams = static_cast<double>(ranges_m.size() + beams_.free_beams().size());
  return matcher_.is_blocked() || motion_.is_scan_frozen() ||
         static_cast<double>(near) > kCoveredShare * beams;
}

ScanMatch LocalMapper::best_match(const GaussianPose& predicted) {
  const ScanMatch match = matcher_.match(map_, predicted);
  if (match.score >= kGoodScore || !match.was_searched || motion_.dt_s() <= 0.0) {
    return match;
  }
  // Odometry that stalls and catches up later is wrong twice; the robot just goes on meanwhile.
  const GaussianPose continued = compounded({T_lpm_robot_, uncertainty_}, motion_.continued());
  const ScanMatch other = matcher_.match(map_, continued);
  return other.score > match.score + kClearlyBetter ? other : match;
}

void LocalMapper::settle(const ScanMatch& match, const GaussianPose& predicted, LocalFix* fix) {
  fix->score = match.score;
  if (match.known_share < kMinKnownShare) {
    fix->note = FixNote::kNoOverlap;
    return;
  }
  if (match.score <
      std::max(options_.match.min_explained_share, kLeastOfUsualScore * match.usual_score)) {
    fix->note = FixNote::kContradiction;
    return;
  }
  fix->T_lpm_robot = match.fit.T_lpm_robot;
  fix->is_matched = true;
  fix->covariance = match_covariance(match.fit.information);
  fix->is_degenerate = is_degenerate(fix->covariance);
  const double deviation =
      squared_mahalanobis(fix->T_lpm_robot, predicted.mean, predicted.covariance);
  fix->note = deviation > kSlip ? FixNote::kSlip : FixNote::kMatched;

  // The map bears its errors along as it is renewed: one independent match per renewal.
  fix->motion.mean = T_lpm_robot_.inverse() * fix->T_lpm_robot;
  const double travel_m = fix->motion.mean.translation().norm() +
                          kRadPerTravel_m * std::abs(fix->motion.mean.theta()) / (2.0 * kPi);
  const double renewed_share = std::min(1.0, travel_m / options_.renewal_travel_m);
  const Matrix3d posterior = (match.fit.information + predicted.covariance.inverse()).inverse() +
                             diagonal(kMatchSigma_m, kMatchSigma_m, kMatchSigma_rad);
  fix->motion.covariance =
      renewed_share * seen_from(0.5 * (posterior + posterior.transpose()), T_lpm_robot_.theta()) +
      diagonal(kStillSigma_m, kStillSigma_m, kStillSigma_rad);
}

void LocalMapper::advance(const JoinedScan& joined, LocalFix* fix) {
  if (!is_started_) {
    motion_.start(joined.scan.time, joined.T_odom_robot);
  } else if (fix->is_matched) {
    fix->fault = motion_.end(
        GaussianPose{fix->motion.mean, seen_from(fix->covariance, T_lpm_robot_.theta())});
  } else {
    fix->fault = motion_.end(std::nullopt);
  }
  travel_m_ += (fix->T_lpm_robot.translation() - T_lpm_robot_.translation()).norm();
  T_lpm_robot_ = fix->T_lpm_robot;
  uncertainty_ = is_refused(fix->note) ? fix->covariance
                                       : diagonal(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad);
  refusals_ = is_refused(fix->note) ? refusals_ + 1 : 0;
  blind_way_m_ = is_refused(fix->note) ? blind_way_m_ : 0.0;
}

/// Whether it is known how the robot came from where it was matched last, though no map says so.
void LocalMapper::note_way(const LocalFix& fix) {
  if (fix.note == FixNote::kBlockedSensor) {
    return;
  }
  Seen& seen = seen_[laser_];
  is_way_known_ =
      !is_refused(fix.note) ||
      (is_way_known_ && motion_.has_odometry() &&
       continuity(beams_, seen.returns, seen.T_lpm_robot.inverse() * T_lpm_robot_) >= kGoesOn);
  seen.T_lpm_robot = T_lpm_robot_;
  seen.returns.resize(beams_.returns().size());
  std::transform(beams_.returns().begin(), beams_.returns().end(), seen.returns.begin(),
                 [](const SurfacePoint& point) { return point.p; });
}

void LocalMapper::ask_what_is_behind_walls(LocalFix* fix) {
  const bool is_calm = fix->fault == MotionFault::kNone && !is_refused(fix->note);
  if (is_calm && ++unasked_ < kAskEvery) {
    return;
  }
  unasked_ = 0;
  fix->through_walls = share_through_walls(map_, beams_, fix->T_lpm_robot);
}

void LocalMapper::correct_heading(LocalFix* fix) {
  const double correction_rad = heading_drift_.correction_rad();
  fix->motion.mean = fix->motion.mean * Pose2(0.0, 0.0, correction_rad - heading_correction_rad_);
  heading_correction_rad_ = correction_rad;
}

/// Walls are asked where the map takes up a scan: scans between see the same of them.
void LocalMapper::ask_walls() {
  if (!options_.wall_orientation.enabled) {
    return;
  }
  if (const auto heading = wall_orientation_.absorb(beams_, T_lpm_robot_)) {
    heading_drift_.absorb(travel_m_, turn_between(heading->theta_rad, T_lpm_robot_.theta()));
  }
}

bool LocalMapper::take_up(const LocalFix& fix) {
  const auto drawn = T_lpm_drawn_.find(laser_);
  bool is_due = drawn == T_lpm_drawn_.end();
  if (!is_due) {
    const Pose2 since = drawn->second.inverse() * T_lpm_robot_;
    is_due = since.translation().norm() >= options_.insert_every_m ||
             std::abs(since.theta()) >= options_.insert_every_rad;
  }
  if (fix.note == FixNote::kBlockedSensor) {
    return false;
  }
  if (fix.note == FixNote::kContradiction) {
    if (refusals_ < options_.refusals_before_restart) {
      return false;
    }
    if (!is_way_known_) {
      start_anew();
      return true;
    }
    clear_map();
    ++renewals_;
    is_due = true;
  }
  if (is_due) {
    draw();
  }
  return is_due;
}

void LocalMapper::start_anew() {
  clear_map();
  ++restarts_;
  draw();
}

void LocalMapper::clear_map() {
  blind_way_m_ = 0.0;
  map_.clear();
  T_lpm_drawn_.clear();
}

void LocalMapper::draw() {
  map_.insert(beams_, T_lpm_robot_, travel_m_);
  ask_walls();
  T_lpm_drawn_[laser_] = T_lpm_robot_;
  uncertainty_ = diagonal(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad);
  refusals_ = 0;
  is_started_ = true;
}

std::size_t LocalMapper::memory_bytes() const {
  return map_.memory_bytes() + matcher_.memory_bytes();
}

void LocalMapper::restore(const LaserScan& scan,
                          const Pose2& T_lpm_robot,
                          const std::optional<Pose2>& T_odom_robot,
                          bool takes_up) {
  if (is_started_) {
    travel_m_ += (T_lpm_robot.translation() - T_lpm_robot_.translation()).norm();
  }
  if (takes_up) {
    map_.insert(scan, T_lpm_robot, travel_m_);
    T_lpm_drawn_[scan.laser] = T_lpm_robot;
  }
  is_started_ = true;
  T_lpm_robot_ = T_lpm_robot;
  uncertainty_ = diagonal(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad);
  motion_.start(scan.time, T_odom_robot);
}

}  // namespace cairn
