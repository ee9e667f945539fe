#include "lpm/global_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/global_search_run.hpp"
#include "lpm/surface_points.hpp"
#include "lpm/turned_scans.hpp"

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;
constexpr double kMaxRange_cells = 15'000.0;
constexpr std::uint8_t kFreenessOfUnknown = 64;  // of 255
constexpr double kBlindSigma_m = 1.0;            // in a direction a scan says nothing about
constexpr double kBlindSigma_rad = 0.5;
constexpr double kMatchSigma_m = 0.01;  // no match is better than this
constexpr double kMatchSigma_rad = 0.003;

Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

}  // namespace

Status validate(const GlobalSearchOptions& options) {
  return Validator("lpm.global_search")
      .positive("hit_sigma_m", options.hit_sigma_m)
      .positive("max_range_m", options.max_range_m)
      .within("max_returns", options.max_returns, 3, 10'000)
      .within("free_weight", options.free_weight, 0.0, 10.0)
      .within("robot_clearance_m", options.robot_clearance_m, 0.0, 10.0)
      .positive("neighbour_m", options.neighbour_m)
      .positive("neighbour_rad", options.neighbour_rad)
      .within("independent_share", options.independent_share, 1e-4, 1.0)
      .status();
}

GlobalSearch::GlobalSearch(const OccupancyGrid& map, const GlobalSearchOptions& options)
    : options_(options), walls_(map.geometry()) {
  CAIRN_CHECK(validate(options).ok());
  if (map.geometry().cell_count() > 0) {
    take(map);
  }
}

void GlobalSearch::take(const OccupancyGrid& map) {
  const GridGeometry& geometry = map.geometry();
  walls_.renew(map, {0, 0}, {geometry.width - 1, geometry.height - 1});
  std::array<std::uint8_t, DistanceField::kFar + 1> likelihood_at{};
  const double sigma_cells = options_.hit_sigma_m / geometry.cell_m;
  for (std::size_t squared = 0; squared < DistanceField::kFar; ++squared) {
    const double exponent = -0.5 * static_cast<double>(squared) / (sigma_cells * sigma_cells);
    likelihood_at[squared] =
        static_cast<std::uint8_t>(std::lround(kFullScore * std::exp(exponent)));
  }
  std::vector<std::uint8_t> likelihood(geometry.cell_count());
  for (int y = 0; y < geometry.height; ++y) {
    walls_.look_up({0, y}, geometry.width, likelihood_at, &likelihood[geometry.index_of({0, y})]);
  }
  std::vector<std::uint8_t> freeness(geometry.cell_count(), 0);
  std::vector<std::uint8_t> allowed(geometry.cell_count(), 0);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const CellState state = map.state({x, y});
      if (state == CellState::kFree) {
        freeness[geometry.index_of({x, y})] = 255;
        allow_around({x, y}, &allowed);
      } else if (state == CellState::kUnknown) {
        freeness[geometry.index_of({x, y})] = kFreenessOfUnknown;
      }
    }
  }
  likelihood_ = SquareMaxima(geometry, likelihood);
  freeness_ = SquareMaxima(geometry, freeness);
  allowed_ = MaxPyramid(geometry, std::move(allowed), TurnedScans::kLevels);
}

void GlobalSearch::allow_around(Cell free_cell, std::vector<std::uint8_t>* allowed) const {
  const GridGeometry& map = geometry();
  const int reach = static_cast<int>(std::floor(options_.robot_clearance_m / map.cell_m));
  const int last_y = std::min(free_cell.y + reach, map.height - 1);
  const int first_x = std::max(free_cell.x - reach, 0);
  const int last_x = std::min(free_cell.x + reach, map.width - 1);
  for (int y = std::max(free_cell.y - reach, 0); y <= last_y; ++y) {
    std::uint8_t* const row = allowed->data() + map.index_of({0, y});
    std::fill(row + first_x, row + last_x + 1, std::uint8_t{1});
  }
}

bool GlobalSearch::is_near(const Pose2& a, const Pose2& b, double neighbourhoods) const {
  return (a.translation() - b.translation()).norm() < neighbourhoods * options_.neighbour_m &&
         std::abs(turn_between(a.theta(), b.theta())) < neighbourhoods * options_.neighbour_rad;
}

std::vector<SurfacePoint> GlobalSearch::chosen(const std::vector<SurfacePoint>& points) const {
  const double max_range_m = std::min(options_.max_range_m, kMaxRange_cells * geometry().cell_m);
  std::vector<SurfacePoint> near;
  for (const SurfacePoint& point : points) {
    if (point.p.norm() <= max_range_m) {
      near.push_back(point);
    }
  }
  return some_of(near, static_cast<std::size_t>(options_.max_returns));
}

std::vector<GlobalMatch> GlobalSearch::find(const std::vector<SurfacePoint>& points,
                                            const GlobalQuery& query) const {
  GlobalSearchRun run(*this, points, query);
  while (!run.is_done()) {
    run.work(std::numeric_limits<std::int64_t>::max());
  }
  return run.found();
}

GlobalMatch GlobalSearch::refined(const std::vector<SurfacePoint>& points,
                                  const Pose2& pose,
                                  double score) const {
  const GaussianPose prior{pose, diagonal(2.0 * options_.hit_sigma_m, 0.1)};
  const Refinement fit =
      refine(walls_, points, prior, pose, {options_.hit_sigma_m, options_.independent_share});
  GlobalMatch match;
  match.raster_pose = pose;
  match.score = score;
  // Least squares may slide off to another wall: then the raster knows better.
  match.T_map_robot.mean = is_near(fit.T_lpm_robot, pose, 1.0) ? fit.T_lpm_robot : pose;
  const Matrix3d regular = fit.information + diagonal(1.0 / kBlindSigma_m, 1.0 / kBlindSigma_rad);
  const Matrix3d covariance = regular.inverse() + diagonal(kMatchSigma_m, kMatchSigma_rad);
  match.T_map_robot.covariance = 0.5 * (covariance + covariance.transpose());
  return match;
}

}  // namespace cairn
