#pragma once

#include <random>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "lpm/scan_refinement.hpp"

namespace cairn::test {

inline constexpr double kCell_m = 0.1;

/// A small building with walls, free and unknown cells at random.
inline OccupancyGrid random_map(std::mt19937* random) {
  GridGeometry geometry;
  geometry.cell_m = kCell_m;
  geometry.origin_m = Vector2d(-1.3, 2.7);
  geometry.width = 14 + static_cast<int>((*random)() % 20);
  geometry.height = 12 + static_cast<int>((*random)() % 15);
  OccupancyGrid map(geometry);
  for (OccupancyGrid::LogOdds& cell : map.cells()) {
    const auto kind = (*random)() % 10;
    cell = static_cast<OccupancyGrid::LogOdds>(kind == 0 ? 300 : (kind < 8 ? -300 : 0));
  }
  return map;
}

inline std::vector<SurfacePoint> random_points(std::mt19937* random) {
  std::uniform_real_distribution<double> any(-1.2, 1.2);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 12; ++i) {
    points.push_back({{any(*random), any(*random)}, Vector2d(1.0, 0.0)});
  }
  return points;
}

}  // namespace cairn::test
