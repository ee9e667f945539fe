#include "lpm/scan_matcher.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kOnWallInSigmas = 2.5;
constexpr double kCertain_m = 0.25;  // sigma up to which the prediction is good to start from
constexpr double kCertain_rad = 0.20;
constexpr double kGoodScore = 0.85;  // a match that leaves no wish for a search
constexpr double kWindowInSigmas = 3.0;
constexpr double kSearchSigma_m = 0.10;  // of the likelihood on the raster
constexpr std::size_t kSearchReturns = 150;
constexpr double kDisagreement = 16.0;  // squared Mahalanobis: the prediction was wrong
constexpr double kDoubt = 100.0;        // then its covariance counts as so much larger

}  // namespace

void ScanMatcher::take(const LaserScan& scan) {
  returns_.clear();
  const double far_m = std::min(options_.max_match_range_m, scan.max_range_m);
  const double spacing2_m2 = options_.point_spacing_m * options_.point_spacing_m;
  Vector2d last = Vector2d::Constant(1e9);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m <= far_m)) {
      continue;
    }
    const double bearing_rad = static_cast<double>(scan.bearings_rad[i]);
    const Vector2d p = scan.T_robot_laser *
                       Vector2d(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
    if ((p - last).squaredNorm() >= spacing2_m2) {
      returns_.push_back(p);
      last = p;
    }
  }
  few_returns_.clear();
  const std::size_t step = 1 + returns_.size() / kSearchReturns;
  for (std::size_t i = 0; i < returns_.size(); i += step) {
    few_returns_.push_back(returns_[i]);
  }
}

bool ScanMatcher::is_blocked() const {
  return returns_.size() < static_cast<std::size_t>(options_.min_returns);
}

ScanMatch ScanMatcher::match(const ScrollingMap& map, const GaussianPose& predicted) {
  const RefinementOptions refinement{options_.hit_sigma_m, options_.independent_share};
  ScanMatch match;
  match.fit = refine(map.walls(), returns_, predicted, predicted.mean, refinement);
  judge(map, &match);
  const Matrix3d& covariance = predicted.covariance;
  const bool is_certain = std::max(covariance(0, 0), covariance(1, 1)) <= kCertain_m * kCertain_m &&
                          covariance(2, 2) <= kCertain_rad * kCertain_rad;
  if (!is_certain || match.score < kGoodScore) {
    search(map, predicted, &match);
  }
  if (squared_mahalanobis(match.fit.T_lpm_robot, predicted.mean, covariance) > kDisagreement) {
    const GaussianPose doubted{predicted.mean, kDoubt * covariance};
    match.fit = refine(map.walls(), returns_, doubted, match.fit.T_lpm_robot, refinement);
    judge(map, &match);
  }
  return match;
}

void ScanMatcher::search(const ScrollingMap& map, const GaussianPose& predicted, ScanMatch* match) {
  const double sigma_m =
      std::sqrt(std::max(predicted.covariance(0, 0), predicted.covariance(1, 1)));
  const double sigma_rad = std::sqrt(predicted.covariance(2, 2));
  SearchWindow window;
  window.center = predicted.mean;
  window.range_m = std::min(options_.search_range_m, 0.1 + kWindowInSigmas * sigma_m);
  window.turn_rad = std::min(options_.search_turn_rad, 0.05 + kWindowInSigmas * sigma_rad);
  window.sigma_m = sigma_m;
  window.sigma_rad = sigma_rad;
  window.independent_share = options_.independent_share;
  search_.prepare(map.walls(), kSearchSigma_m);
  const SearchResult found = search_.find(few_returns_, window);
  ScanMatch other;
  other.was_searched = true;
  other.fit = refine(map.walls(), returns_, predicted, found.pose,
                     {options_.hit_sigma_m, options_.independent_share});
  judge(map, &other);
  match->was_searched = true;
  if (other.fit.cost < match->fit.cost) {
    *match = other;
  }
}

void ScanMatcher::judge(const ScrollingMap& map, ScanMatch* match) const {
  const GridGeometry& geometry = map.grid().geometry();
  const double on_wall_m = std::max(kOnWallInSigmas * options_.hit_sigma_m, geometry.cell_m);
  int known = 0;
  int on_wall = 0;
  for (const Vector2d& p : returns_) {
    const Cell c = geometry.cell_at(match->fit.T_lpm_robot * p);
    const bool is_on_wall = map.walls().distance_m(c) <= on_wall_m;
    on_wall += is_on_wall ? 1 : 0;
    known += is_on_wall || map.grid().state(c) != CellState::kUnknown ? 1 : 0;
  }
  match->score = known > 0 ? static_cast<double>(on_wall) / known : 0.0;
  match->known_share =
      returns_.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(returns_.size());
}

}  // namespace cairn
