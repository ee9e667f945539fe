#include "lpm/global_localiser.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/LU>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr std::size_t kCapacity = 3;  // candidates kept, in searches' worth
constexpr double kSame_m = 0.5;       // candidates closer than this are one
constexpr double kSame_rad = 0.3;
constexpr double kWindowInSigmas = 3.0;
constexpr double kLeastWindow_m = 0.15;
constexpr double kLeastWindow_rad = 0.05;
constexpr double kUsualScoreGain = 0.05;  // per key scan

bool is_same(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kSame_m &&
         std::abs(turn_between(a.theta(), b.theta())) < kSame_rad;
}

/// Two independent beliefs about one pose.
GaussianPose fused(const GaussianPose& predicted, const GaussianPose& measured) {
  const Eigen::Vector3d innovation(measured.mean.x() - predicted.mean.x(),
                                   measured.mean.y() - predicted.mean.y(),
                                   turn_between(predicted.mean.theta(), measured.mean.theta()));
  const Matrix3d gain =
      predicted.covariance * (predicted.covariance + measured.covariance).inverse();
  const Eigen::Vector3d change = gain * innovation;
  const Matrix3d keep = Matrix3d::Identity() - gain;
  const Matrix3d covariance = keep * predicted.covariance * keep.transpose() +
                              gain * measured.covariance * gain.transpose();
  return {Pose2(predicted.mean.x() + change.x(), predicted.mean.y() + change.y(),
                predicted.mean.theta() + change.z()),
          0.5 * (covariance + covariance.transpose())};
}

}  // namespace

Status validate(const GlobalLocaliserOptions& options) {
  return Validator("lpm.global_localiser")
      .positive("key_scan_every_m", options.key_scan_every_m)
      .positive("key_scan_every_rad", options.key_scan_every_rad)
      .within("candidates", options.candidates, 2, 100)
      .within("key_scans", options.key_scans, 2, 100)
      .within("accept_travel_m", options.accept_travel_m, 0.0, 1000.0)
      .within("accept_score", options.accept_score, 0.0, 1.0)
      .within("accept_margin", options.accept_margin, 0.0, 1.0)
      .within("drop_margin", options.drop_margin, 0.0, 1.0)
      .positive("follow_range_m", options.follow_range_m)
      .positive("follow_turn_rad", options.follow_turn_rad)
      .within("doubt_drop", options.doubt_drop, 0.0, 1.0)
      .within("lost_drop", options.lost_drop, 0.0, 1.0)
      .status();
}

std::string_view to_string(Localisation state) {
  switch (state) {
    case Localisation::kSearching:
      return "searching";
    case Localisation::kAccepted:
      return "accepted";
    case Localisation::kTracking:
      return "tracking";
    case Localisation::kLost:
      return "lost";
  }
  return "unknown";
}

GlobalLocaliser::GlobalLocaliser(const GlobalSearch& search, const GlobalLocaliserOptions& options)
    : search_(search), options_(options) {
  CAIRN_CHECK(validate(options).ok());
}

double GlobalLocaliser::Candidate::mean_score() const {
  return std::accumulate(scores.begin(), scores.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(scores.size(), 1));
}

GlobalFix GlobalLocaliser::absorb(const std::vector<SurfacePoint>& points,
                                  const GaussianPose& step) {
  if (!key_scans_.empty()) {
    T_key_robot_ = compounded(T_key_robot_, step);
    travel_m_ += step.mean.translation().norm();
  }
  if (is_key_scan()) {
    add_key_scan(points);
    return is_localised_ ? track() : search();
  }
  GlobalFix fix = summary(is_localised_ ? Localisation::kTracking : Localisation::kSearching);
  if (is_localised_) {
    fix.T_map_robot = compounded(*fix.T_map_robot, T_key_robot_);
  }
  return fix;
}

GlobalFix GlobalLocaliser::summary(Localisation state) const {
  GlobalFix fix;
  fix.state = state;
  if (!candidates_.empty()) {
    fix.score = candidates_.front().mean_score();
    fix.margin = margin_;
    if (is_localised_) {
      fix.T_map_robot = candidates_.front().T_map_robot;
    }
  }
  return fix;
}

bool GlobalLocaliser::is_key_scan() const {
  return key_scans_.empty() ||
         T_key_robot_.mean.translation().norm() >= options_.key_scan_every_m ||
         std::abs(T_key_robot_.mean.theta()) >= options_.key_scan_every_rad;
}

void GlobalLocaliser::add_key_scan(const std::vector<SurfacePoint>& points) {
  key_scans_.push_back({points, T_key_robot_, travel_m_});
  T_key_robot_ = {};
  if (key_scans_.size() > static_cast<std::size_t>(options_.key_scans)) {
    key_scans_.pop_front();
    for (Candidate& candidate : candidates_) {
      candidate.scores.pop_front();
    }
  }
}

GlobalMatch GlobalLocaliser::followed(const std::vector<SurfacePoint>& points,
                                      const GaussianPose& predicted) const {
  const Matrix3d& covariance = predicted.covariance;
  const double sigma_m = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  const GlobalWindow window{
      predicted.mean,
      std::clamp(kWindowInSigmas * sigma_m, kLeastWindow_m, options_.follow_range_m),
      std::clamp(kWindowInSigmas * std::sqrt(covariance(2, 2)), kLeastWindow_rad,
                 options_.follow_turn_rad)};
  const std::vector<GlobalMatch> best = search_.find(points, {1, 0.0, window});
  GlobalMatch match = best.empty() ? GlobalMatch{} : best.front();
  // Along a corridor all poses are as good: there, the prediction knows better.
  match.T_map_robot = best.empty() ? predicted : fused(predicted, match.T_map_robot);
  return match;
}

/// The candidates explain the newest key scan.
void GlobalLocaliser::follow_candidates() {
  const KeyScan& now = key_scans_.back();
  for (Candidate& candidate : candidates_) {
    const GlobalMatch match =
        followed(now.points, compounded(candidate.T_map_robot, now.T_before_this));
    candidate.T_map_robot = match.T_map_robot;
    candidate.scores.push_back(match.score);
  }
}

/// A candidate explains the key scans that were before it was thought of.
GlobalLocaliser::Candidate GlobalLocaliser::looked_back(const GlobalMatch& match,
                                                        std::size_t scans) const {
  Candidate candidate{match.T_map_robot, {match.score}};
  GaussianPose T_map_robot = match.T_map_robot;
  for (std::size_t i = key_scans_.size() - 1; i > 0 && candidate.scores.size() < scans; --i) {
    const GaussianPose step = inverted(key_scans_[i].T_before_this);
    const GlobalMatch earlier = followed(key_scans_[i - 1].points, compounded(T_map_robot, step));
    T_map_robot = earlier.T_map_robot;
    candidate.scores.push_front(earlier.score);
  }
  return candidate;
}

void GlobalLocaliser::put_forward() {
  ++searches_;
  for (const GlobalMatch& match : search_.find(key_scans_.back().points, {options_.candidates})) {
    const bool is_new =
        std::none_of(candidates_.begin(), candidates_.end(), [&](const Candidate& known) {
          return is_same(known.T_map_robot.mean, match.T_map_robot.mean);
        });
    if (is_new) {
      candidates_.push_back(looked_back(match, key_scans_.size()));
    }
  }
}

void GlobalLocaliser::rank() {
  std::stable_sort(
      candidates_.begin(), candidates_.end(),
      [](const Candidate& a, const Candidate& b) { return a.mean_score() > b.mean_score(); });
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates_) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& better) {
      return is_same(better.T_map_robot.mean, candidate.T_map_robot.mean);
    });
    const bool is_hopeless =
        !kept.empty() && candidate.mean_score() < kept.front().mean_score() - options_.drop_margin;
    if (!is_known && !is_hopeless &&
        kept.size() < kCapacity * static_cast<std::size_t>(options_.candidates)) {
      kept.push_back(std::move(candidate));
    }
  }
  candidates_ = std::move(kept);
}

double GlobalLocaliser::margin() const {
  if (candidates_.empty()) {
    return 0.0;
  }
  const double next = candidates_.size() > 1 ? candidates_[1].mean_score()
                                             : candidates_[0].mean_score() - options_.drop_margin;
  return candidates_[0].mean_score() - next;
}

bool GlobalLocaliser::is_acceptable() const {
  return !candidates_.empty() &&
         key_scans_.size() == static_cast<std::size_t>(options_.key_scans) &&
         key_scans_.back().travel_m - key_scans_.front().travel_m >= options_.accept_travel_m &&
         candidates_.front().mean_score() >= options_.accept_score &&
         margin() >= options_.accept_margin;
}

GlobalFix GlobalLocaliser::search() {
  follow_candidates();
  put_forward();
  rank();
  margin_ = margin();
  if (!is_acceptable()) {
    return summary(Localisation::kSearching);
  }
  is_localised_ = true;
  usual_score_ = candidates_.front().mean_score();
  candidates_.resize(1);
  return summary(Localisation::kAccepted);
}

GlobalFix GlobalLocaliser::track() {
  follow_candidates();
  if (is_still_there()) {
    return summary(Localisation::kTracking);
  }
  const GlobalFix fix = summary(Localisation::kLost);
  is_localised_ = false;
  candidates_.clear();
  key_scans_.clear();
  return {fix.state, std::nullopt, fix.score, fix.margin};
}

/// Whether the key scans of late still speak for where the robot is said to be.
bool GlobalLocaliser::is_still_there() {
  const std::deque<double>& scores = candidates_.front().scores;
  const std::size_t late = std::max<std::size_t>(scores.size() / 3, 1);
  const double late_score =
      std::accumulate(scores.end() - static_cast<std::ptrdiff_t>(late), scores.end(), 0.0) /
      static_cast<double>(late);
  if (late_score < usual_score_ - options_.lost_drop) {
    return false;
  }
  if (late_score < usual_score_ - options_.doubt_drop) {
    return !has_better(late, late_score + options_.doubt_drop);
  }
  usual_score_ += kUsualScoreGain * (late_score - usual_score_);
  return true;
}

bool GlobalLocaliser::has_better(std::size_t late, double score) {
  ++searches_;
  const std::vector<GlobalMatch> matches =
      search_.find(key_scans_.back().points, {options_.candidates});
  return std::any_of(matches.begin(), matches.end(), [&](const GlobalMatch& match) {
    return looked_back(match, late).mean_score() > score;
  });
}

}  // namespace cairn
