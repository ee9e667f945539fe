#include "lpm/correlative_search.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

constexpr double kSigma_m = 0.1;

/// Mean likelihood of points at a pose, as the search defines it.
double likelihood_by_hand(const DistanceField& walls,
                          const std::vector<SurfacePoint>& points,
                          const Pose2& center,
                          const Cell& offset) {
  double sum = 0.0;
  for (const auto& [p, normal] : points) {
    Cell c = walls.geometry().cell_at(center * p);
    c = {c.x + offset.x, c.y + offset.y};
    const std::uint8_t squared = walls.squared_cells(c);
    if (squared < DistanceField::kFar) {
      const double cells = kSigma_m / walls.geometry().cell_m;
      sum += std::round(255.0 * std::exp(-0.5 * squared / (cells * cells)));
    }
  }
  return sum / (255.0 * static_cast<double>(points.size()));
}

TEST(CorrelativeSearch, FindsTheBestPoseOfItsWindow) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const int step = 1 << (seed % 3);  // of the raster, in cells
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.3, 4.5);
    GridGeometry geometry;
    geometry.cell_m = 0.1;
    geometry.width = 50;
    geometry.height = 50;
    DistanceField walls(geometry);
    for (int i = 0; i < 40; ++i) {
      walls.add_wall(geometry.cell_at({coordinate(random), coordinate(random)}));
    }
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 15; ++i) {
      const double x_m = coordinate(random) - 2.5;
      points.push_back({Vector2d(x_m, coordinate(random) - 2.5)});
    }
    SearchWindow window;
    window.center = Pose2(2.5, 2.5, 0.3);
    window.range_m = 1.0;
    window.turn_rad = 0.2;
    window.step_level = static_cast<int>(seed % 3);
    CorrelativeSearch search;
    search.prepare(walls, kSigma_m, window.center.translation(), 10.0);
    const SearchResult found = search.find(points, window);

    double best = 0.0;
    double farthest_m = 1.0;
    for (const SurfacePoint& point : points) {
      farthest_m = std::max(farthest_m, point.p.norm());
    }
    const int angles =
        static_cast<int>(std::ceil(window.turn_rad * farthest_m / (step * geometry.cell_m)));
    const int reach = step * static_cast<int>(std::ceil(10.0 / step));
    for (int a = -angles; a <= angles; ++a) {
      const Pose2 turned(window.center.translation(),
                         window.center.theta() + a * window.turn_rad / angles);
      for (int y = -reach; y <= reach; y += step) {
        for (int x = -reach; x <= reach; x += step) {
          best = std::max(best, likelihood_by_hand(walls, points, turned, {x, y}));
        }
      }
    }
    EXPECT_NEAR(found.score, best, 1e-9);
  }
}

TEST(CorrelativeSearch, StaysAtTheCenterWhereThereAreNoWalls) {
  GridGeometry geometry;
  geometry.width = 64;
  geometry.height = 64;
  CorrelativeSearch search;
  SearchWindow window;
  window.center = Pose2(1.0, 1.0, 0.5);
  search.prepare(DistanceField(geometry), kSigma_m, window.center.translation(), 1.0);
  const SearchResult found = search.find({{Vector2d(0.5, 0.0)}, {Vector2d(0.0, 0.5)}}, window);
  EXPECT_EQ(found.pose, window.center);
  EXPECT_EQ(found.score, 0.0);
}

}  // namespace
}  // namespace cairn
