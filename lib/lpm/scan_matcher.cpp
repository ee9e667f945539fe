#include "lpm/scan_matcher.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "lpm/match_score.hpp"
#include "lpm/surface_points.hpp"
#include "lpm/surface_refinement.hpp"

namespace cairn {
namespace {

constexpr double kOnWall_m = 0.125;
constexpr double kCertain_m = 0.25;  // sigma up to which the prediction is good to start from
constexpr double kCertain_rad = 0.20;
constexpr double kGoodScore = 0.85;  // a match that leaves no wish for a search
constexpr double kWindowInSigmas = 3.0;
constexpr double kSearchSigma_m = 0.10;  // of the likelihood on the raster
constexpr std::size_t kSearchReturns = 60;
constexpr int kSearchStepLevel = 1;
constexpr double kSearchReach_m = 7.0;
constexpr double kFarthest_m = 16.0;  // what is farther takes memory, and lies outside of most maps
constexpr double kUnusual = 0.15;     // so much below the usual score, a search is due
constexpr double kVeryUnusual = 0.20;  // so much below, odometry is in doubt
constexpr double kAgrees = 9.0;        // squared Mahalanobis: as odometry says
constexpr double kLeastUsual = 0.8;
constexpr double kUsualShare = 0.1;      // of the last match in what is usual
constexpr double kDoubt = 25.0;          // then its covariance counts as so much larger
constexpr double kRefuted = 16.0;        // squared Mahalanobis: odometry was wrong
constexpr double kAnyHeading_rad = 2.0;  // sigma of a heading nothing is known of
constexpr double kWholeScore = 0.90;
constexpr double kHeld_per_m2 = 1.0 / (0.04 * 0.04);

}  // namespace

Matrix3d ScanMatch::covariance(double hit_sigma_m) const {
  constexpr double kBlind = 1.0;  // information of what is not known at all, 1/m^2 and 1/rad^2
  const double measured = hit_sigma_m / fit.spread_m;
  const Matrix3d covariance =
      (measured * measured * fit.information + kBlind * Matrix3d::Identity()).inverse();
  return 0.5 * (covariance + covariance.transpose());
}

void UsualScore::learn(double score) {
  value_ += kUsualShare * (std::max(score, kLeastUsual) - value_);
}

void ScanMatcher::take(const ScanBeams& beams) {
  is_prepared_ = false;
  surface_points_of(beams, options_.point_spacing_m, options_.max_match_range_m, &returns_);
}

/// Evenly over the scan; near ones if there are enough, since every angle that tells far ones apart
/// has to be looked at.
void ScanMatcher::choose_few() {
  const auto is_near = [](const SurfacePoint& point) {
    return point.p.squaredNorm() <= kSearchReach_m * kSearchReach_m;
  };
  const auto near =
      static_cast<std::size_t>(std::count_if(returns_.begin(), returns_.end(), is_near));
  const bool takes_all = near < returns_.size() / 2;
  const auto is_far = [](const SurfacePoint& point) {
    return point.p.squaredNorm() > kFarthest_m * kFarthest_m;
  };
  const std::size_t step = 1 + (takes_all ? returns_.size() : near) / kSearchReturns;
  few_returns_.clear();
  reach_m_ = 0.0;
  std::size_t seen = 0;
  for (const SurfacePoint& point : returns_) {
    if ((takes_all ? !is_far(point) : is_near(point)) && seen++ % step == 0) {
      few_returns_.push_back(point);
      reach_m_ = std::max(reach_m_, point.p.norm());
    }
  }
}

bool ScanMatcher::is_blocked() const {
  return returns_.size() < static_cast<std::size_t>(options_.min_returns);
}

ScanMatch ScanMatcher::match(const ScrollingMap& map, const GaussianPose& predicted) {
  ScanMatch match = nearby(map, predicted);
  const bool is_doubtful = match.score < usual_score_.value() - kVeryUnusual;
  doubts_ = is_doubtful ? doubts_ + 1 : 0;
  // What was looked for in vain is looked for again ever more seldom: the 1st, 2nd, 4th, 8th time.
  if (is_doubtful && (doubts_ & (doubts_ - 1U)) == 0U) {
    match = in_doubt(map, predicted, match);
  }
  match.usual_score = usual_score_.value();
  usual_score_.learn(match.score);
  return match;
}

/// The match that believes odometry, as far as it says that it can be believed.
ScanMatch ScanMatcher::nearby(const ScrollingMap& map, const GaussianPose& predicted) {
  ScanMatch match = refined(map, predicted, predicted.mean);
  const Matrix3d& covariance = predicted.covariance;
  const auto deviation = [&](const ScanMatch& found) {
    return squared_mahalanobis(found.fit.T_lpm_robot, predicted.mean, covariance);
  };
  const bool is_certain = std::max(covariance(0, 0), covariance(1, 1)) <= kCertain_m * kCertain_m &&
                          covariance(2, 2) <= kCertain_rad * kCertain_rad;
  const double wanted =
      is_certain && deviation(match) <= kAgrees ? usual_score_.value() - kUnusual : kGoodScore;
  if (match.score < wanted) {
    const ScanMatch wider = searched(map, predicted, options_.search_turn_rad);
    if (wider.fit.cost < match.fit.cost) {
      match = wider;
    }
    match.was_searched = true;
  }
  if (deviation(match) > kRefuted) {
    const bool was_searched = match.was_searched;
    match = refined(map, {predicted.mean, kDoubt * covariance}, match.fit.T_lpm_robot);
    match.was_searched = was_searched;
  }
  return match;
}

/// Odometry may be plain wrong. What contradicts it must explain clearly more than what does not.
ScanMatch ScanMatcher::in_doubt(const ScrollingMap& map,
                                const GaussianPose& predicted,
                                const ScanMatch& believed) {
  // At most half of what the belief leaves unexplained may remain so.
  const auto is_far_better = [&believed](const ScanMatch& match) {
    const auto unexplained = [](const ScanMatch& m) { return 1.0 - m.score * m.known_share; };
    return unexplained(match) < 0.5 * unexplained(believed);
  };
  ScanMatch match = believed;
  // A slip, a push.
  GaussianPose doubted{predicted.mean, kDoubt * predicted.covariance};
  const ScanMatch slipped = searched(map, doubted, options_.search_turn_rad);
  if (slipped.score >= kGoodScore && is_far_better(slipped)) {
    match = slipped;
  }
  if (match.score < usual_score_.value() - kVeryUnusual) {
    // Turned by hand, or while nobody looked. A corridor looks the same both ways: the scan has to
    // be explained nearly whole, and to hold the robot in every direction.
    doubted.covariance(2, 2) = kAnyHeading_rad * kAnyHeading_rad;
    const ScanMatch turned = searched(map, doubted, kPi);
    const double held = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(
                            Eigen::Matrix2d(turned.fit.information.topLeftCorner<2, 2>()))
                            .eigenvalues()
                            .x();
    if (turned.score >= kWholeScore && held >= kHeld_per_m2 && is_far_better(turned)) {
      match = turned;
    }
  }
  match.was_searched = true;
  return match;
}

ScanMatch ScanMatcher::refined(const ScrollingMap& map,
                               const GaussianPose& predicted,
                               const Pose2& start) const {
  ScanMatch match;
  match.fit = refine_on_surfaces(map, returns_, predicted, start,
                                 {options_.hit_sigma_m, options_.independent_share});
  judge(map, returns_, kOnWall_m, &match);
  return match;
}

void ScanMatcher::prepare_search(const ScrollingMap& map, const Pose2& around) {
  const Vector2d off_m = around.translation() - prepared_at_m_;
  if (!is_prepared_) {
    choose_few();
  }
  if (!is_prepared_ || off_m.cwiseAbs().maxCoeff() > options_.search_range_m) {
    // Room for the window, and for the next search of the same scan from somewhere nearby.
    search_.prepare(map.walls(), kSearchSigma_m, around.translation(),
                    reach_m_ + 2.0 * options_.search_range_m);
    prepared_at_m_ = around.translation();
    is_prepared_ = true;
  }
}

ScanMatch ScanMatcher::searched(const ScrollingMap& map,
                                const GaussianPose& predicted,
                                double most_turn_rad) {
  SearchWindow window;
  window.center = predicted.mean;
  window.sigma_m = std::sqrt(std::max(predicted.covariance(0, 0), predicted.covariance(1, 1)));
  window.sigma_rad = std::sqrt(predicted.covariance(2, 2));
  window.range_m = std::min(options_.search_range_m, kWindowInSigmas * window.sigma_m);
  window.turn_rad = std::min(most_turn_rad, kWindowInSigmas * window.sigma_rad);
  window.independent_share = options_.independent_share;
  window.step_level = kSearchStepLevel;
  prepare_search(map, predicted.mean);
  ScanMatch match = refined(map, predicted, search_.find(few_returns_, window).pose);
  match.was_searched = true;
  return match;
}

}  // namespace cairn
