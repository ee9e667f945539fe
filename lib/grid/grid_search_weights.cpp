// What the cells of a search cost.

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "grid/distance_transform.hpp"
#include "grid/grid_search.hpp"

namespace cairn {

Status validate(const GridSearchOptions& options) {
  return Validator("grid_search")
      .within("robot_radius_m", options.robot_radius_m, 0.0, 10.0)
      .within("comfort_clearance_m", options.comfort_clearance_m, 0.0, 10.0)
      .within("wall_cost", options.wall_cost, 0.0, 14.0)
      .status();
}

void GridSearch::measure_clearance(const OccupancyGrid& grid) {
  OccupancyGrid walls = grid;
  for (OccupancyGrid::LogOdds& value : walls.cells()) {
    if (value <= OccupancyGrid::kOccupiedAbove) {
      value = OccupancyGrid::kFreeBelow - 1;
    }
  }
  const DistanceTransform distances = distance_transform(walls);
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const double cells = std::sqrt(distances.squared_clearance_cells({x, y}));
      tenths_clearance_[index_of({x, y})] =
          static_cast<std::uint16_t>(std::min(65535L, std::lround(10.0 * cells)));
    }
  }
}

void GridSearch::set_weights(const OccupancyGrid& grid, const GridSearchOptions& options) {
  const double margin_m = options.comfort_clearance_m - options.robot_radius_m;
  const double far_m = std::max(options.comfort_clearance_m, options.robot_radius_m);
  std::vector<std::uint8_t> weight_at{0};  // By tenths of cells of clearance; the last is for more.
  for (double clearance = 0.0; clearance <= far_m;) {
    clearance = 0.1 * geometry_.cell_m * static_cast<double>(weight_at.size());
    const double nearness =
        margin_m > 0.0 ? std::clamp((options.comfort_clearance_m - clearance) / margin_m, 0.0, 1.0)
                       : 0.0;
    weight_at.push_back(static_cast<std::uint8_t>(
        clearance < options.robot_radius_m
            ? 0
            : std::lround(kOpenWeight * (1.0 + options.wall_cost * nearness))));
  }
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      if (options.unknown_is_traversable || grid.state({x, y}) == CellState::kFree) {
        const std::size_t tenths = tenths_clearance_[index_of({x, y})];
        weight_[index_of({x, y})] = weight_at[std::min(tenths, weight_at.size() - 1)];
      }
    }
  }
}

GridSearch GridSearch::coarsened(int factor) const {
  CAIRN_CHECK(factor >= 1);
  GridGeometry large = geometry_;
  large.cell_m *= factor;
  large.width = (geometry_.width + factor - 1) / factor;
  large.height = (geometry_.height + factor - 1) / factor;
  GridSearch coarse(large);
  std::vector<std::uint32_t> sum(coarse.weight_.size());
  std::vector<std::uint32_t> count(coarse.weight_.size());
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const std::uint32_t small = index_of({x, y});
      const std::uint32_t index = coarse.index_of({x / factor, y / factor});
      sum[index] += weight_[small];
      count[index] += weight_[small] > 0 ? 1U : 0U;
      coarse.tenths_clearance_[index] =
          std::max(coarse.tenths_clearance_[index],
                   static_cast<std::uint16_t>(tenths_clearance_[small] / factor));
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    coarse.weight_[i] = static_cast<std::uint8_t>(
        2 * count[i] < static_cast<std::uint32_t>(factor * factor) ? 0 : sum[i] / count[i]);
  }
  return coarse;
}

}  // namespace cairn
