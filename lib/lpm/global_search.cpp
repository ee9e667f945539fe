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

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;
constexpr double kMaxRange_cells = 15'000.0;
constexpr std::uint8_t kFreenessOfUnknown = 64;  // of 255
constexpr double kBlindSigma_m = 1.0;            // in a direction a scan says nothing about
constexpr double kBlindSigma_rad = 0.5;
constexpr double kMatchSigma_m = 0.01;  // no match is better than this
constexpr double kMatchSigma_rad = 0.003;

constexpr int kStepsPerRow = 4;
constexpr std::int64_t kWorkPerWall = 200;  // in cells, about
constexpr std::int64_t kWorkPerFreeCell = 10;

/// Of the low corner of a cell, among all corners of cells.
std::size_t corner(const GridGeometry& map, Cell cell) {
  return static_cast<std::size_t>(cell.y) * (static_cast<std::size_t>(map.width) + 1) +
         static_cast<std::size_t>(cell.x);
}

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

GlobalSearch::GlobalSearch(const GridGeometry& geometry, const GlobalSearchOptions& options)
    : options_(options), walls_(geometry), likelihood_(geometry), freeness_(geometry) {
  CAIRN_CHECK(validate(options).ok());
  const double sigma_cells = options_.hit_sigma_m / geometry.cell_m;
  for (std::size_t squared = 0; squared < DistanceField::kFar; ++squared) {
    const double exponent = -0.5 * static_cast<double>(squared) / (sigma_cells * sigma_cells);
    likelihood_at_[squared] =
        static_cast<std::uint8_t>(std::lround(kFullScore * std::exp(exponent)));
  }
  allowed_.resize(geometry.cell_count());
  fits_.resize(corner(geometry, {0, geometry.height + 1}));
}

GlobalSearch::GlobalSearch(const OccupancyGrid& map, const GlobalSearchOptions& options)
    : GlobalSearch(map.geometry(), options) {
  while (!is_taken()) {
    take(map, std::numeric_limits<std::int64_t>::max());
  }
}

void GlobalSearch::take(const OccupancyGrid& map, std::int64_t cells) {
  while (!is_taken() && cells > 0) {
    cells -= take_step(map, next_step_++);
  }
}

int GlobalSearch::step_count() const {
  return kStepsPerRow * geometry().height + static_cast<int>(SquareMaxima::kSides_cells.size()) - 1;
}

std::int64_t GlobalSearch::take_step(const OccupancyGrid& map, int step) {
  const int rows = geometry().height;
  if (step >= kStepsPerRow * rows) {
    return widen(step - kStepsPerRow * rows + 1);
  }
  switch (step / rows) {
    case 0:
      return take_walls(map, step % rows);
    case 1:
      return take_likelihood(step % rows);
    case 2:
      return take_free(map, step % rows);
    default:
      return take_fits(step % rows);
  }
}

std::int64_t GlobalSearch::take_walls(const OccupancyGrid& map, int y) {
  std::int64_t walls = 0;
  for (int x = 0; x < geometry().width; ++x) {
    if (map.state({x, y}) == CellState::kOccupied) {
      walls_.add_wall({x, y});
      ++walls;
    }
  }
  return geometry().width + walls * kWorkPerWall;
}

std::int64_t GlobalSearch::take_likelihood(int y) {
  walls_.look_up({0, y}, geometry().width, likelihood_at_, likelihood_.row(y));
  return geometry().width;
}

std::int64_t GlobalSearch::take_free(const OccupancyGrid& map, int y) {
  std::uint8_t* const row = freeness_.row(y);
  std::int64_t free = 0;
  for (int x = 0; x < geometry().width; ++x) {
    const CellState state = map.state({x, y});
    if (state == CellState::kFree) {
      row[x] = 255;
      allow_around({x, y});
      ++free;
    } else if (state == CellState::kUnknown) {
      row[x] = kFreenessOfUnknown;
    }
  }
  return geometry().width + free * kWorkPerFreeCell;
}

std::int64_t GlobalSearch::take_fits(int y) {
  const GridGeometry& map = geometry();
  std::int32_t in_row = 0;
  for (int x = 0; x < map.width; ++x) {
    in_row += allowed_[map.index_of({x, y})];
    fits_[corner(map, {x + 1, y + 1})] = fits_[corner(map, {x + 1, y})] + in_row;
  }
  return map.width;
}

std::int64_t GlobalSearch::widen(int kind) {
  likelihood_.widen(kind);
  freeness_.widen(kind);
  return static_cast<std::int64_t>(geometry().cell_count());
}

void GlobalSearch::allow_around(Cell free_cell) {
  const GridGeometry& map = geometry();
  const int reach = static_cast<int>(std::floor(options_.robot_clearance_m / map.cell_m));
  const int last_y = std::min(free_cell.y + reach, map.height - 1);
  const int first_x = std::max(free_cell.x - reach, 0);
  const int last_x = std::min(free_cell.x + reach, map.width - 1);
  for (int y = std::max(free_cell.y - reach, 0); y <= last_y; ++y) {
    std::uint8_t* const row = allowed_.data() + map.index_of({0, y});
    std::fill(row + first_x, row + last_x + 1, std::uint8_t{1});
  }
}

bool GlobalSearch::fits(Cell low, int side_cells) const {
  const GridGeometry& map = geometry();
  const Cell end{std::min(low.x + side_cells, map.width), std::min(low.y + side_cells, map.height)};
  return fits_[corner(map, end)] - fits_[corner(map, {low.x, end.y})] -
             fits_[corner(map, {end.x, low.y})] + fits_[corner(map, low)] >
         0;
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
