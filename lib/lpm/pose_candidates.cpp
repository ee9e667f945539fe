#include "lpm/pose_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/LU>

namespace cairn {
namespace {

constexpr std::size_t kCapacity = 3;  // candidates kept, in searches' worth
constexpr double kSame_m = 0.5;       // candidates closer than this are one
constexpr double kSame_rad = 0.3;
constexpr double kWindowInSigmas = 3.0;
constexpr double kLeastWindow_m = 0.15;
constexpr double kLeastWindow_rad = 0.05;

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

/// Along a corridor all poses are as good: there, the prediction knows better.
GlobalMatch matched(const GaussianPose& predicted, const std::vector<GlobalMatch>& best) {
  GlobalMatch match = best.empty() ? GlobalMatch{} : best.front();
  match.T_map_robot = best.empty() ? predicted : fused(predicted, match.T_map_robot);
  return match;
}

}  // namespace

double PoseCandidates::Candidate::mean_score() const {
  return std::accumulate(scores.begin(), scores.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(scores.size(), 1));
}

PoseCandidates::PoseCandidates(const GlobalSearch& search, const GlobalLocaliserOptions& options)
    : search_(search), options_(options) {}

void PoseCandidates::add_key_scan(KeyScan scan) {
  key_scans_.push_back(std::move(scan));
  ++newest_;
  if (key_scans_.size() <= static_cast<std::size_t>(options_.key_scans)) {
    return;
  }
  key_scans_.pop_front();
  following_.reset();  // it may be about the scan that has gone
  for (Candidate& candidate : candidates_) {
    const auto most =
        static_cast<std::size_t>(std::max<std::int64_t>(candidate.last + 1 - oldest(), 0));
    while (candidate.scores.size() > most) {
      candidate.scores.pop_front();
    }
  }
  // Those that were followed to no scan that is left have lost their way.
  candidates_.erase(
      std::remove_if(candidates_.begin(), candidates_.end(),
                     [this](const Candidate& candidate) { return candidate.last < oldest(); }),
      candidates_.end());
}

void PoseCandidates::put_forward(const GaussianPose& T_map_robot) {
  const bool is_known =
      std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& known) {
        return known.last == newest_ && is_same(known.T_map_last.mean, T_map_robot.mean);
      });
  if (!is_known) {
    candidates_.push_back({T_map_robot, T_map_robot, newest_, next_id_++, {}});
  }
}

/// First the candidates are brought up to now, then back to what was before them.
std::optional<PoseCandidates::Step> PoseCandidates::due() const {
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].scores.empty()) {
      return Step{i, candidates_[i].last, false};
    }
    if (candidates_[i].last < newest_) {
      return Step{i, candidates_[i].last + 1, false};
    }
  }
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].scores.size() < key_scans_.size()) {
      return Step{i, newest_ - static_cast<std::int64_t>(candidates_[i].scores.size()), true};
    }
  }
  return std::nullopt;
}

GaussianPose PoseCandidates::predicted(const Step& step) const {
  const Candidate& candidate = candidates_[step.candidate];
  if (step.is_back) {
    return compounded(candidate.T_map_first, inverted(key_scan(step.key_scan + 1).T_before_this));
  }
  return candidate.scores.empty()
             ? candidate.T_map_last
             : compounded(candidate.T_map_last, key_scan(step.key_scan).T_before_this);
}

GlobalQuery PoseCandidates::window_around(const GaussianPose& predicted) const {
  const Matrix3d& covariance = predicted.covariance;
  const double sigma_m = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  const double sigma_rad = std::sqrt(covariance(2, 2));
  return {1,
          0.0,
          {predicted.mean,
           std::clamp(kWindowInSigmas * sigma_m, kLeastWindow_m, options_.follow_range_m),
           std::clamp(kWindowInSigmas * sigma_rad, kLeastWindow_rad, options_.follow_turn_rad)}};
}

std::int64_t PoseCandidates::work(std::int64_t lookups) {
  std::int64_t done = 0;
  while (done < lookups) {
    if (!following_) {
      const std::optional<Step> step = due();
      if (!step) {
        return done;
      }
      const GaussianPose pose = predicted(*step);
      following_.emplace(Following{
          *step, pose,
          GlobalSearchRun(search_, key_scan(step->key_scan).points, window_around(pose))});
    }
    GlobalSearchRun& run = following_->run;
    const std::int64_t before = run.lookups();
    run.work(lookups - done);
    done += std::max<std::int64_t>(run.lookups() - before, 1);
    if (run.is_done()) {
      take(*following_);
      following_.reset();
    }
  }
  return done;
}

void PoseCandidates::take(const Following& following) {
  const Step& step = following.step;
  Candidate& candidate = candidates_[step.candidate];
  const GlobalMatch match = matched(following.predicted, following.run.found());
  if (step.is_back) {
    candidate.scores.push_front(match.score);
    candidate.T_map_first = match.T_map_robot;
  } else {
    candidate.T_map_first = candidate.scores.empty() ? match.T_map_robot : candidate.T_map_first;
    candidate.T_map_last = match.T_map_robot;
    candidate.scores.push_back(match.score);
    candidate.last = step.key_scan;
  }
  if (!is_chosen_ && is_hopeless(candidate)) {
    candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(step.candidate));
  }
}

/// Whether a candidate would be far behind the best one even if it explained what is still to be
/// explained perfectly.
bool PoseCandidates::is_hopeless(const Candidate& candidate) const {
  const auto all = static_cast<double>(key_scans_.size());
  const auto seen = static_cast<double>(candidate.scores.size());
  const double at_best = (candidate.mean_score() * seen + std::max(all - seen, 0.0)) / all;
  return at_best < best_score_ - options_.drop_margin;
}

void PoseCandidates::rank() {
  std::stable_sort(
      candidates_.begin(), candidates_.end(),
      [](const Candidate& a, const Candidate& b) { return a.mean_score() > b.mean_score(); });
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates_) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& better) {
      return is_same(better.T_map_last.mean, candidate.T_map_last.mean);
    });
    const bool is_far_behind =
        !kept.empty() && candidate.mean_score() < kept.front().mean_score() - options_.drop_margin;
    if (!is_known && !is_far_behind &&
        kept.size() < kCapacity * static_cast<std::size_t>(options_.candidates)) {
      kept.push_back(std::move(candidate));
    }
  }
  candidates_ = std::move(kept);
  best_score_ = candidates_.empty() ? 0.0 : candidates_.front().mean_score();
}

void PoseCandidates::keep_best() {
  following_.reset();
  candidates_.erase(candidates_.begin() + 1, candidates_.end());
  is_chosen_ = true;
}

void PoseCandidates::clear() {
  best_score_ = 0.0;
  is_chosen_ = false;
  following_.reset();
  candidates_.clear();
  key_scans_.clear();
}

double PoseCandidates::margin() const {
  if (candidates_.empty()) {
    return 0.0;
  }
  const double next = candidates_.size() > 1 ? candidates_[1].mean_score()
                                             : candidates_[0].mean_score() - options_.drop_margin;
  return candidates_[0].mean_score() - next;
}

double PoseCandidates::mean_score_of(const GlobalMatch& match, std::size_t scans) const {
  double sum = match.score;
  GaussianPose T_map_robot = match.T_map_robot;
  const std::int64_t first = std::max(oldest(), newest_ + 1 - static_cast<std::int64_t>(scans));
  for (std::int64_t i = newest_; i > first; --i) {
    const GaussianPose pose = compounded(T_map_robot, inverted(key_scan(i).T_before_this));
    const GlobalMatch earlier =
        matched(pose, search_.find(key_scan(i - 1).points, window_around(pose)));
    T_map_robot = earlier.T_map_robot;
    sum += earlier.score;
  }
  return sum / static_cast<double>(newest_ + 1 - first);
}

}  // namespace cairn
