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
constexpr double kPoorScore = 0.80;      // a match that casts doubt on odometry
constexpr double kDoubt = 25.0;          // then its covariance counts as so much larger
constexpr double kRefuted = 16.0;        // squared Mahalanobis: odometry was wrong
constexpr double kClearlyBetter = 0.10;  // in score
constexpr double kNeighbour_m = 1.0;     // farther returns are no neighbours on a surface
constexpr double kEdge = 3.0;            // ratio of distances to neighbours across an edge

}  // namespace

void ScanMatcher::take(const LaserScan& scan) {
  returns_.clear();
  is_prepared_ = false;
  farthest_m_ = 0.0;
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
      returns_.push_back({p, Vector2d::Zero()});
      last = p;
      farthest_m_ = std::max(farthest_m_, p.norm());
    }
  }
  find_normals();
  few_returns_.clear();
  const std::size_t step = 1 + returns_.size() / kSearchReturns;
  for (std::size_t i = 0; i < returns_.size(); i += step) {
    few_returns_.push_back(returns_[i]);
  }
}

bool ScanMatcher::is_blocked() const {
  return returns_.size() < static_cast<std::size_t>(options_.min_returns);
}

void ScanMatcher::find_normals() {
  const auto distance_m = [this](std::size_t i, std::size_t j) {
    return (returns_[j].p - returns_[i].p).norm();
  };
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    const double before_m = i > 0 ? distance_m(i - 1, i) : kNeighbour_m;
    const double after_m = i + 1 < returns_.size() ? distance_m(i, i + 1) : kNeighbour_m;
    // Across an edge the neighbour belongs to another surface.
    const bool takes_before = before_m < kNeighbour_m && before_m < kEdge * after_m;
    const bool takes_after = after_m < kNeighbour_m && after_m < kEdge * before_m;
    if (!takes_before && !takes_after) {
      continue;
    }
    const Vector2d along =
        returns_[takes_after ? i + 1 : i].p - returns_[takes_before ? i - 1 : i].p;
    returns_[i].normal = Vector2d(-along.y(), along.x()).normalized();
  }
}

ScanMatch ScanMatcher::match(const ScrollingMap& map, const GaussianPose& predicted) {
  ScanMatch match = best_match(map, predicted);
  if (squared_mahalanobis(match.fit.T_lpm_robot, predicted.mean, predicted.covariance) > kRefuted) {
    const bool was_searched = match.was_searched;
    match = refined(map, {predicted.mean, kDoubt * predicted.covariance}, match.fit.T_lpm_robot);
    match.was_searched = was_searched;
  }
  return match;
}

ScanMatch ScanMatcher::best_match(const ScrollingMap& map, const GaussianPose& predicted) {
  ScanMatch match = refined(map, predicted, predicted.mean);
  const Matrix3d& covariance = predicted.covariance;
  const bool is_certain = std::max(covariance(0, 0), covariance(1, 1)) <= kCertain_m * kCertain_m &&
                          covariance(2, 2) <= kCertain_rad * kCertain_rad;
  if (is_certain && match.score >= kGoodScore) {
    return match;
  }
  const ScanMatch wider = searched(map, predicted);
  if (wider.fit.cost < match.fit.cost) {
    match = wider;
  }
  match.was_searched = true;
  if (match.score < kPoorScore) {
    // Odometry may be plain wrong: a slip, a push. That takes a clearly better fit.
    const ScanMatch doubted = searched(map, {predicted.mean, kDoubt * covariance});
    if (doubted.score > match.score + kClearlyBetter) {
      match = doubted;
    }
  }
  return match;
}

ScanMatch ScanMatcher::refined(const ScrollingMap& map,
                               const GaussianPose& predicted,
                               const Pose2& start) const {
  ScanMatch match;
  match.fit = refine(map.walls(), returns_, predicted, start,
                     {options_.hit_sigma_m, options_.independent_share});
  judge(map, &match);
  return match;
}

void ScanMatcher::prepare_search(const ScrollingMap& map, const Pose2& around) {
  // Room for the search window, and for the next search of the same scan from somewhere nearby.
  const double reach_m = farthest_m_ + 2.0 * options_.search_range_m;
  const Vector2d off_m = around.translation() - prepared_at_m_;
  if (!is_prepared_ || off_m.cwiseAbs().maxCoeff() > options_.search_range_m) {
    search_.prepare(map.walls(), kSearchSigma_m, around.translation(), reach_m);
    prepared_at_m_ = around.translation();
    is_prepared_ = true;
  }
}

ScanMatch ScanMatcher::searched(const ScrollingMap& map, const GaussianPose& predicted) {
  SearchWindow window;
  window.center = predicted.mean;
  window.sigma_m = std::sqrt(std::max(predicted.covariance(0, 0), predicted.covariance(1, 1)));
  window.sigma_rad = std::sqrt(predicted.covariance(2, 2));
  window.range_m = std::min(options_.search_range_m, kWindowInSigmas * window.sigma_m);
  window.turn_rad = std::min(options_.search_turn_rad, kWindowInSigmas * window.sigma_rad);
  window.independent_share = options_.independent_share;
  prepare_search(map, predicted.mean);
  ScanMatch match = refined(map, predicted, search_.find(few_returns_, window).pose);
  match.was_searched = true;
  return match;
}

void ScanMatcher::judge(const ScrollingMap& map, ScanMatch* match) const {
  const GridGeometry& geometry = map.grid().geometry();
  const double on_wall_m = std::max(kOnWallInSigmas * options_.hit_sigma_m, geometry.cell_m);
  int known = 0;
  int on_wall = 0;
  for (const SurfacePoint& point : returns_) {
    const Cell c = geometry.cell_at(match->fit.T_lpm_robot * point.p);
    const bool is_on_wall = map.walls().distance_m(c) <= on_wall_m;
    on_wall += is_on_wall ? 1 : 0;
    known += is_on_wall || map.grid().state(c) != CellState::kUnknown ? 1 : 0;
  }
  match->score = known > 0 ? static_cast<double>(on_wall) / known : 0.0;
  match->known_share =
      returns_.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(returns_.size());
}

}  // namespace cairn
