#include "lpm/global_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/surface_points.hpp"

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;
constexpr double kMaxAngles = 4'000.0;
constexpr std::array<double, 2> kOnTheWay{0.4, 0.8};  // shares of the range of a return
constexpr std::uint8_t kFreenessOfUnknown = 64;       // of 255
constexpr double kBlindSigma_m = 1.0;                 // in a direction a scan says nothing about
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

bool GlobalSearch::IsWorse::operator()(const Block& a, const Block& b) const {
  return std::tie(a.score, b.level, a.turned, a.low) < std::tie(b.score, a.level, b.turned, b.low);
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
  likelihood_ = MaxPyramid(geometry, std::move(likelihood));
  freeness_ = MaxPyramid(geometry, std::move(freeness));
  allowed_ = MaxPyramid(geometry, std::move(allowed));
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

GlobalSearch::Box GlobalSearch::box_of(const GlobalWindow& window) const {
  const GridGeometry& map = geometry();
  const auto clamped = [&map](double x_m, double y_m) {
    const double x = std::floor((x_m - map.origin_m.x()) / map.cell_m);
    const double y = std::floor((y_m - map.origin_m.y()) / map.cell_m);
    return Cell{static_cast<int>(std::clamp(x, -1.0, 1.0 * map.width)),
                static_cast<int>(std::clamp(y, -1.0, 1.0 * map.height))};
  };
  Box box{clamped(window.center.x() - window.range_m, window.center.y() - window.range_m),
          clamped(window.center.x() + window.range_m, window.center.y() + window.range_m)};
  box.low = {std::max(box.low.x, 0), std::max(box.low.y, 0)};
  box.high = {std::min(box.high.x, map.width - 1), std::min(box.high.y, map.height - 1)};
  return box;
}

std::vector<GlobalSearch::Turned> GlobalSearch::turned(const std::vector<SurfacePoint>& points,
                                                       const GlobalWindow& window) const {
  double farthest_m = geometry().cell_m;
  for (const SurfacePoint& point : points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  const double wanted = std::ceil(2.0 * kPi * farthest_m / geometry().cell_m);
  const int angles = static_cast<int>(std::min(wanted, kMaxAngles));
  std::vector<Turned> all;
  for (int i = 0; i < angles; ++i) {
    Turned turned{wrap_angle(2.0 * kPi * i / angles), {}, {}};
    if (std::abs(turn_between(window.center.theta(), turned.theta_rad)) > window.turn_rad) {
      continue;
    }
    const Pose2 turn(0.0, 0.0, turned.theta_rad);
    const auto add = [this](const Vector2d& cells, CellOffsets* offsets) {
      offsets->add(
          {static_cast<int>(std::lround(cells.x())), static_cast<int>(std::lround(cells.y()))},
          geometry().width);
    };
    for (const SurfacePoint& point : points) {
      const Vector2d cells = (turn * point.p) / geometry().cell_m;
      add(cells, &turned.returns);
      for (const double share : kOnTheWay) {
        add(share * cells, &turned.ways);
      }
    }
    all.push_back(std::move(turned));
  }
  return all;
}

double GlobalSearch::bound_of(const Block& block, const Turned& turned) const {
  const double weight = options_.free_weight / static_cast<double>(kOnTheWay.size());
  double sum = likelihood_.greatest_sum(turned.returns, block.low, block.level);
  if (weight > 0.0) {
    sum += weight * freeness_.greatest_sum(turned.ways, block.low, block.level);
  }
  return sum / (kFullScore * (1.0 + options_.free_weight) *
                static_cast<double>(turned.returns.cells.size()));
}

bool GlobalSearch::is_neighbour(const Pose2& a, const Pose2& b) const {
  return (a.translation() - b.translation()).norm() < options_.neighbour_m &&
         std::abs(turn_between(a.theta(), b.theta())) < options_.neighbour_rad;
}

std::vector<SurfacePoint> GlobalSearch::chosen(const std::vector<SurfacePoint>& points) const {
  std::vector<SurfacePoint> near;
  for (const SurfacePoint& point : points) {
    if (point.p.norm() <= options_.max_range_m) {
      near.push_back(point);
    }
  }
  return some_of(near, static_cast<std::size_t>(options_.max_returns));
}

void GlobalSearch::push(Block block, const Box& box, const Turned& turned, Open* open) const {
  const bool is_inside = block.low.x <= box.high.x && block.low.y <= box.high.y;
  if (is_inside && allowed_.greatest(block.low, block.level) != 0) {
    block.score = bound_of(block, turned);
    open->push(block);
  }
}

GlobalSearch::Open GlobalSearch::opened(const Box& box, const std::vector<Turned>& all) const {
  const int widest = std::max(box.high.x - box.low.x, box.high.y - box.low.y) + 1;
  int top = 0;
  while (top + 1 < MaxPyramid::kLevels && (2 << top) <= widest) {
    ++top;
  }
  Open open;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int y = box.low.y; y <= box.high.y; y += 1 << top) {
      for (int x = box.low.x; x <= box.high.x; x += 1 << top) {
        push({0.0, top, static_cast<std::int32_t>(i), {x, y}}, box, all[i], &open);
      }
    }
  }
  return open;
}

std::vector<GlobalMatch> GlobalSearch::find(const std::vector<SurfacePoint>& points,
                                            int count,
                                            const GlobalWindow& window) const {
  const std::vector<SurfacePoint> some = chosen(points);
  const Box box = box_of(window);
  std::vector<GlobalMatch> found;
  if (some.empty() || box.low.x > box.high.x || box.low.y > box.high.y) {
    return found;
  }
  const std::vector<Turned> all = turned(some, window);
  Open open = opened(box, all);
  while (!open.empty() && found.size() < static_cast<std::size_t>(std::max(count, 0))) {
    const Block best = open.top();
    open.pop();
    const Turned& turned = all[static_cast<std::size_t>(best.turned)];
    if (best.level > 0) {
      const int half = 1 << (best.level - 1);
      for (const Cell& by : {Cell{0, 0}, Cell{half, 0}, Cell{0, half}, Cell{half, half}}) {
        const Cell low{best.low.x + by.x, best.low.y + by.y};
        push({0.0, best.level - 1, best.turned, low}, box, turned, &open);
      }
      continue;
    }
    const Pose2 pose(geometry().center_of(best.low), turned.theta_rad);
    const bool is_new = std::none_of(found.begin(), found.end(), [&](const GlobalMatch& better) {
      return is_neighbour(pose, better.raster_pose);
    });
    if (is_new) {
      found.push_back(refined(some, pose, best.score));
    }
  }
  return found;
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
  match.T_map_robot.mean = is_neighbour(fit.T_lpm_robot, pose) ? fit.T_lpm_robot : pose;
  const Matrix3d regular = fit.information + diagonal(1.0 / kBlindSigma_m, 1.0 / kBlindSigma_rad);
  const Matrix3d covariance = regular.inverse() + diagonal(kMatchSigma_m, kMatchSigma_rad);
  match.T_map_robot.covariance = 0.5 * (covariance + covariance.transpose());
  return match;
}

}  // namespace cairn
