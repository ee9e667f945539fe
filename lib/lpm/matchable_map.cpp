#include "lpm/matchable_map.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

// Enough for the pose of least squares: walls are lines, and their cells tell much the same.
constexpr std::size_t kMostPoints = 400;
constexpr std::size_t kMostKnown = 1'000;
constexpr double kSearchSigmaInSigmas = 1.5;

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

std::vector<CellState> states_of(const OccupancyGrid& grid) {
  std::vector<CellState> states;
  states.reserve(grid.geometry().cell_count());
  for (int y = 0; y < grid.geometry().height; ++y) {
    for (int x = 0; x < grid.geometry().width; ++x) {
      states.push_back(grid.state({x, y}));
    }
  }
  return states;
}

/// At most so many of the cells, evenly spread over their order.
std::vector<Cell> some_cells(const std::vector<Cell>& cells, std::size_t most) {
  const std::size_t count = std::min(cells.size(), most);
  std::vector<Cell> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    some.push_back(cells[i * cells.size() / count]);
  }
  return some;
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

MatchableMap::MatchableMap(const OccupancyGrid& map, const MapMatchOptions& options)
    : walls_(walls_of(map)),
      raster_(walls_, kSearchSigmaInSigmas * options.hit_sigma_m, options.search_range_m),
      states_(states_of(map)) {
  CAIRN_CHECK(validate(options).ok());
  take_walls(map);
  take_known();
}

void MatchableMap::take_walls(const OccupancyGrid& map) {
  std::vector<Cell> walls;
  for (int y = 0; y < geometry().height; ++y) {
    for (int x = 0; x < geometry().width; ++x) {
      if (state({x, y}) == CellState::kOccupied) {
        walls.push_back({x, y});
        center_ += geometry().center_of({x, y});
      }
    }
  }
  if (walls.empty()) {
    return;
  }
  // Turns are about the middle of the walls: the origin of the frame may be far away.
  center_ /= static_cast<double>(walls.size());
  const std::vector<Cell> some = some_cells(walls, kMostPoints);
  walls_per_point_ = static_cast<double>(walls.size()) / static_cast<double>(some.size());
  for (const Cell& wall : some) {
    points_.push_back({geometry().center_of(wall) - center_, wall_normal(map, wall)});
  }
}

void MatchableMap::take_known() {
  std::vector<Cell> known;
  for (int y = 0; y < geometry().height; ++y) {
    for (int x = 0; x < geometry().width; ++x) {
      if (state({x, y}) != CellState::kUnknown) {
        known.push_back({x, y});
      }
    }
  }
  known_ = some_cells(known, kMostKnown);
}

std::size_t MatchableMap::memory_bytes() const {
  return walls_.memory_bytes() + raster_.memory_bytes() + states_.capacity() * sizeof(CellState) +
         points_.capacity() * sizeof(SurfacePoint) + known_.capacity() * sizeof(Cell);
}

}  // namespace cairn
