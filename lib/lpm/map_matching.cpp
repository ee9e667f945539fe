#include "lpm/map_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/LU>

#include "base/check.hpp"

namespace cairn {
namespace {

constexpr double kIndependentShare = 0.1;  // of wall cells: neighbours tell the same
constexpr double kOnWallInSigmas = 2.0;
constexpr double kDeepInSigmas = 4.0;  // from here on a free cell denies a wall
constexpr double kBlindSigma_m = 3.0;
constexpr double kBlindSigma_rad = 1.0;
constexpr double kLeastSigma_m = 0.01;
constexpr double kLeastSigma_rad = 0.003;
// Weights of features_of(), by logistic regression on some 13,000 pairs of visits to junctions of
// the simulated buildings 1 to 14, 570 of them to the same junction, the others mostly to alike
// ones: `cairn-lab recognition --worlds 14 --seed 1`, which fits them anew and tells how far they
// hold in other buildings.
constexpr MatchFeatures kWeights{-16.303, -3.014, -3.052, 6.694};
// Beyond this no pair was different, of 25,000, and 156 were the same, of 1,100: how much more it
// says than this cannot be told.
constexpr double kMaxLogLikelihoodRatio = 7.0;
constexpr double kEnoughWalls_m = 20.0;  // of both maps; fewer witnesses count in proportion

Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// How the walls of one map meet another one. Counts in wall cells.
struct WallsMet {
  double over_known = 0.0;
  double on_walls = 0.0;
  double in_free_space = 0.0;  // deep in it

  friend WallsMet operator+(const WallsMet& a, const WallsMet& b) {
    return {a.over_known + b.over_known, a.on_walls + b.on_walls,
            a.in_free_space + b.in_free_space};
  }
};

WallsMet walls_met(const MatchableMap& reference,
                   const MatchableMap& other,
                   const Pose2& T_reference_other,
                   double hit_sigma_m) {
  const double on_wall_m = std::max(kOnWallInSigmas * hit_sigma_m, reference.geometry().cell_m);
  const double deep_m = kDeepInSigmas * hit_sigma_m;
  const Pose2 T_reference_center = T_reference_other * Pose2(other.center(), 0.0);
  WallsMet met;
  for (const SurfacePoint& point : other.points()) {
    const Cell there = reference.geometry().cell_at(T_reference_center * point.p);
    const CellState state = reference.state(there);
    const double wall_m = reference.walls().distance_m(there);
    const bool is_on_wall = wall_m <= on_wall_m;
    if (state != CellState::kUnknown || is_on_wall) {
      met.over_known += other.walls_per_point();
      met.on_walls += is_on_wall ? other.walls_per_point() : 0.0;
      const bool is_denied = state == CellState::kFree && wall_m > deep_m;
      met.in_free_space += is_denied ? other.walls_per_point() : 0.0;
    }
  }
  return met;
}

/// Share of the known cells of one map that are known in the other, too.
double share_known(const MatchableMap& reference,
                   const MatchableMap& other,
                   const Pose2& T_reference_other) {
  std::size_t known = 0;
  for (const Cell& cell : other.known()) {
    const Vector2d p = T_reference_other * other.geometry().center_of(cell);
    known += reference.state(reference.geometry().cell_at(p)) != CellState::kUnknown ? 1U : 0U;
  }
  return other.known().empty()
             ? 0.0
             : static_cast<double>(known) / static_cast<double>(other.known().size());
}

double share_of(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

double log_likelihood_ratio(const MapMatch& match) {
  const MatchFeatures features = features_of(match);
  const double ratio = std::inner_product(features.begin(), features.end(), kWeights.begin(), 0.0);
  return std::clamp(ratio, -kMaxLogLikelihoodRatio, kMaxLogLikelihoodRatio) *
         std::min(match.common_walls_m / kEnoughWalls_m, 1.0);
}

/// Where the middle of the other's walls lies in the reference: search, then least squares.
GaussianPose matched_center(const MatchableMap& reference,
                            const MatchableMap& other,
                            const Pose2& T_reference_center_guess,
                            const MapMatchOptions& options) {
  SearchWindow window;
  window.center = T_reference_center_guess;
  window.range_m = options.search_range_m;
  window.turn_rad = options.search_turn_rad;
  window.independent_share = kIndependentShare;
  const SearchResult found = reference.raster().find(other.points(), window);
  const GaussianPose prior{window.center, diagonal(kBlindSigma_m, kBlindSigma_rad)};
  // Each point stands for several.
  const double share = std::min(kIndependentShare * other.walls_per_point(), 1.0);
  const Refinement fit =
      refine(reference.walls(), other.points(), prior, found.pose, {options.hit_sigma_m, share});
  const Matrix3d covariance = (fit.information + prior.covariance.inverse()).inverse() +
                              diagonal(kLeastSigma_m, kLeastSigma_rad);
  return {fit.T_lpm_robot, 0.5 * (covariance + covariance.transpose())};
}

}  // namespace

MatchFeatures features_of(const MapMatch& match) {
  // A few hundredths disagree between any two maps; less is no better.
  constexpr double kAlwaysBeside = 0.02;
  constexpr double kAlwaysDenied = 0.05;
  // Places differ in size; only more walls than most have in common speak for the same.
  constexpr double kUsualWalls_m = 40.0;
  constexpr double kManyWalls_m = 80.0;
  const double beside = std::max(1.0 - match.occupied_agreement - match.free_conflict, 0.0);
  const double walls_m = std::clamp(match.common_walls_m, kUsualWalls_m, kManyWalls_m);
  return {1.0, std::log(beside + kAlwaysBeside), std::log(match.free_conflict + kAlwaysDenied),
          std::log(walls_m / kUsualWalls_m)};
}

MapMatch match_maps(const MatchableMap& reference,
                    const MatchableMap& other,
                    const Pose2& T_reference_other_guess,
                    const MapMatchOptions& options) {
  CAIRN_CHECK(validate(options).ok());
  CAIRN_CHECK(reference.geometry().cell_m == other.geometry().cell_m);
  MapMatch match;
  match.T_reference_other = {T_reference_other_guess, diagonal(kBlindSigma_m, kBlindSigma_rad)};
  if (other.points().empty()) {
    return match;
  }
  const Pose2 T_other_center(other.center(), 0.0);
  const Pose2 guess = T_reference_other_guess * T_other_center;
  const GaussianPose T_reference_center = matched_center(reference, other, guess, options);
  match.T_reference_other =
      compounded(T_reference_center, {T_other_center.inverse(), Matrix3d::Zero()});
  match.shift_m = (T_reference_center.mean.translation() - guess.translation()).norm();
  match.shift_rad = std::abs(turn_between(guess.theta(), T_reference_center.mean.theta()));
  const Pose2& T_reference_other = match.T_reference_other.mean;
  const WallsMet met =
      walls_met(reference, other, T_reference_other, options.hit_sigma_m) +
      walls_met(other, reference, T_reference_other.inverse(), options.hit_sigma_m);
  match.occupied_agreement = share_of(met.on_walls, met.over_known);
  match.free_conflict = share_of(met.in_free_space, met.over_known);
  match.common_walls_m = met.over_known * reference.geometry().cell_m;
  match.overlap_share = share_known(reference, other, T_reference_other);
  if (match.overlap_share >= options.min_overlap_share) {
    match.log_likelihood_ratio = log_likelihood_ratio(match);
  }
  return match;
}

MapMatch match_maps(const OccupancyGrid& reference,
                    const OccupancyGrid& other,
                    const Pose2& T_reference_other_guess,
                    const MapMatchOptions& options) {
  return match_maps(MatchableMap(reference, options), MatchableMap(other, options),
                    T_reference_other_guess, options);
}

}  // namespace cairn
