#include "lpm/map_matching.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/correlative_search.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/scan_refinement.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxWallPoints = 1'000;
constexpr double kIndependentShare = 0.1;  // of wall cells: neighbours tell the same
constexpr double kSearchSigmaInSigmas = 1.5;
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

DistanceField walls_of(const OccupancyGrid& grid) {
  DistanceField walls(grid.geometry());
  walls.renew(grid, {0, 0}, {grid.geometry().width - 1, grid.geometry().height - 1});
  return walls;
}

/// Across the wall through a cell: the direction in which the wall cells around it spread least.
Vector2d wall_normal(const OccupancyGrid& grid, Cell wall) {
  constexpr int kNeighbourhood = 3;
  Vector2d sum = Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double count = 0.0;
  for (int dy = -kNeighbourhood; dy <= kNeighbourhood; ++dy) {
    for (int dx = -kNeighbourhood; dx <= kNeighbourhood; ++dx) {
      if (grid.state({wall.x + dx, wall.y + dy}) == CellState::kOccupied) {
        const Vector2d d(dx, dy);
        sum += d;
        squares += d * d.transpose();
        count += 1.0;
      }
    }
  }
  if (count < 3.0) {
    return Vector2d::Zero();
  }
  const Eigen::Matrix2d spread = squares / count - sum * sum.transpose() / (count * count);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(0);
}

std::vector<SurfacePoint> wall_points(const OccupancyGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  std::vector<SurfacePoint> points;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      if (grid.state({x, y}) == CellState::kOccupied) {
        points.push_back({geometry.center_of({x, y}), Vector2d::Zero()});
      }
    }
  }
  return points;
}

/// Some of the points, as seen from the middle, with the directions of their walls.
std::vector<SurfacePoint> thinned(const std::vector<SurfacePoint>& points,
                                  const OccupancyGrid& grid,
                                  const Vector2d& center) {
  std::vector<SurfacePoint> few;
  const std::size_t step = 1 + points.size() / kMaxWallPoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Cell wall = grid.geometry().cell_at(points[i].p);
    few.push_back({points[i].p - center, wall_normal(grid, wall)});
  }
  return few;
}

/// How the cells of two maps meet at a pose.
struct Meeting {
  std::size_t known_of_other = 0;
  std::size_t known_in_both = 0;
  std::size_t walls_over_known = 0;
  std::size_t walls_on_walls = 0;
  std::size_t conflicts = 0;
};

Meeting meeting_of(const OccupancyGrid& reference,
                   const DistanceField& walls_of_reference,
                   const OccupancyGrid& other,
                   const DistanceField& walls_of_other,
                   const std::pair<Pose2, double>& pose_and_sigma_m) {
  const auto& [T_reference_other, sigma_m] = pose_and_sigma_m;
  const double on_wall_m = std::max(kOnWallInSigmas * sigma_m, reference.geometry().cell_m);
  const double deep_m = kDeepInSigmas * sigma_m;
  Meeting meeting;
  for (int y = 0; y < other.geometry().height; ++y) {
    for (int x = 0; x < other.geometry().width; ++x) {
      const Cell here{x, y};
      const CellState state = other.state(here);
      if (state == CellState::kUnknown) {
        continue;
      }
      ++meeting.known_of_other;
      const Cell there =
          reference.geometry().cell_at(T_reference_other * other.geometry().center_of(here));
      const CellState state_there = reference.state(there);
      const double wall_m = walls_of_reference.distance_m(there);
      const bool is_wall = state == CellState::kOccupied;
      const bool is_on_wall = wall_m <= on_wall_m;
      if (state_there == CellState::kUnknown && !(is_wall && is_on_wall)) {
        continue;
      }
      ++meeting.known_in_both;
      meeting.walls_over_known += is_wall ? 1 : 0;
      meeting.walls_on_walls += is_wall && is_on_wall ? 1 : 0;
      const bool denies =
          is_wall ? state_there == CellState::kFree && wall_m > deep_m
                  : state_there == CellState::kOccupied && walls_of_other.distance_m(here) > deep_m;
      meeting.conflicts += denies ? 1 : 0;
    }
  }
  return meeting;
}

double share_of(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// Independent witnesses, each of which agrees or not: a ratio of binomial likelihoods.
double log_likelihood_ratio(const Meeting& meeting, double cell_m) {
  const double agreement = share_of(meeting.walls_on_walls, meeting.walls_over_known);
  const double witnesses = static_cast<double>(meeting.walls_over_known) * cell_m / kWitness_m;
  const double per_witness =
      agreement * std::log(kAgreesIfSame / kAgreesIfDifferent) +
      (1.0 - agreement) * std::log((1.0 - kAgreesIfSame) / (1.0 - kAgreesIfDifferent));
  return std::clamp(witnesses * per_witness, -kMaxLogLikelihoodRatio, kMaxLogLikelihoodRatio);
}

}  // namespace

Status validate(const MapMatchOptions& options) {
  return Validator("map_match")
      .within("search_range_m", options.search_range_m, 0.0, 20.0)
      .within("search_turn_rad", options.search_turn_rad, 0.0, 3.2)
      .within("hit_sigma_m", options.hit_sigma_m, 0.001, 1.0)
      .within("min_overlap_share", options.min_overlap_share, 0.0, 1.0)
      .status();
}

MapMatch match_maps(const OccupancyGrid& reference,
                    const OccupancyGrid& other,
                    const Pose2& T_reference_other_guess,
                    const MapMatchOptions& options) {
  CAIRN_CHECK(validate(options).ok());
  CAIRN_CHECK(reference.geometry().cell_m == other.geometry().cell_m);
  const std::vector<SurfacePoint> points = wall_points(other);
  MapMatch match;
  match.T_reference_other = {T_reference_other_guess, diagonal(kBlindSigma_m, kBlindSigma_rad)};
  if (points.empty()) {
    return match;
  }
  // Turns are about the middle of the walls: the origin of the frame may be far away.
  Vector2d center = Vector2d::Zero();
  for (const SurfacePoint& point : points) {
    center += point.p / static_cast<double>(points.size());
  }
  const Pose2 T_other_center(center, 0.0);
  const std::vector<SurfacePoint> p_center = thinned(points, other, center);
  const DistanceField walls = walls_of(reference);

  CorrelativeSearch search;
  SearchWindow window;
  window.center = T_reference_other_guess * T_other_center;
  window.range_m = options.search_range_m;
  window.turn_rad = options.search_turn_rad;
  window.independent_share = kIndependentShare;
  const double whole_m =
      reference.geometry().cell_m * (reference.geometry().width + reference.geometry().height);
  search.prepare(walls, kSearchSigmaInSigmas * options.hit_sigma_m,
                 reference.geometry().center_of(
                     {reference.geometry().width / 2, reference.geometry().height / 2}),
                 whole_m);
  const SearchResult found = search.find(p_center, window);
  const GaussianPose prior{window.center, diagonal(kBlindSigma_m, kBlindSigma_rad)};
  const Refinement fit =
      refine(walls, p_center, prior, found.pose, {options.hit_sigma_m, kIndependentShare});

  const Matrix3d covariance = (fit.information + prior.covariance.inverse()).inverse() +
                              diagonal(kLeastSigma_m, kLeastSigma_rad);
  match.T_reference_other =
      compounded({fit.T_lpm_robot, 0.5 * (covariance + covariance.transpose())},
                 {T_other_center.inverse(), Matrix3d::Zero()});
  const Meeting meeting = meeting_of(reference, walls, other, walls_of(other),
                                     {match.T_reference_other.mean, options.hit_sigma_m});
  match.occupied_agreement = share_of(meeting.walls_on_walls, meeting.walls_over_known);
  match.free_conflict = share_of(meeting.conflicts, meeting.known_in_both);
  match.overlap_share = share_of(meeting.known_in_both, meeting.known_of_other);
  if (match.overlap_share >= options.min_overlap_share) {
    match.log_likelihood_ratio = log_likelihood_ratio(meeting, reference.geometry().cell_m);
  }
  return match;
}

}  // namespace cairn
