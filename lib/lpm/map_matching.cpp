#include "lpm/map_matching.hpp"

#include <algorithm>
#include <cmath>
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
constexpr double kMaxLogLikelihoodRatio = 20.0;
// A patch of wall this long is one independent witness.
constexpr double kWitness_m = 0.5;
// Chance that a wall cell of one map falls on a wall of the other, at the best pose of the window.
constexpr double kAgreesIfSame = 0.90;
constexpr double kAgreesIfDifferent = 0.65;

Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// How the walls of one map meet another one. Counts in wall cells.
struct WallsMet {
  double over_known = 0.0;
  double on_walls = 0.0;
  double in_free_space = 0.0;  // deep in it
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

/// Independent witnesses, each of which agrees or not: a ratio of binomial likelihoods.
double log_likelihood_ratio(const WallsMet& met, double cell_m) {
  const double agreement = share_of(met.on_walls, met.over_known);
  const double witnesses = met.over_known * cell_m / kWitness_m;
  const double per_witness =
      agreement * std::log(kAgreesIfSame / kAgreesIfDifferent) +
      (1.0 - agreement) * std::log((1.0 - kAgreesIfSame) / (1.0 - kAgreesIfDifferent));
  return std::clamp(witnesses * per_witness, -kMaxLogLikelihoodRatio, kMaxLogLikelihoodRatio);
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
  match.T_reference_other = compounded(
      matched_center(reference, other, T_reference_other_guess * T_other_center, options),
      {T_other_center.inverse(), Matrix3d::Zero()});
  const Pose2& T_reference_other = match.T_reference_other.mean;
  const WallsMet others = walls_met(reference, other, T_reference_other, options.hit_sigma_m);
  const WallsMet references =
      walls_met(other, reference, T_reference_other.inverse(), options.hit_sigma_m);
  match.occupied_agreement = share_of(others.on_walls, others.over_known);
  match.free_conflict = share_of(others.in_free_space + references.in_free_space,
                                 others.over_known + references.over_known);
  match.overlap_share = share_known(reference, other, T_reference_other);
  if (match.overlap_share >= options.min_overlap_share) {
    match.log_likelihood_ratio = log_likelihood_ratio(others, reference.geometry().cell_m);
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
