#include "lpm/wall_raster.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

constexpr double kSigma_m = 0.1;
constexpr double kReach_m = 1.0;

/// A map of 5 m x 5 m with some wall cells, and some points in its middle.
struct Scene {
  explicit Scene(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.3, 4.5);
    for (int i = 0; i < 60; ++i) {
      walls.add_wall(walls.geometry().cell_at({coordinate(random), coordinate(random)}));
    }
    for (int i = 0; i < 20; ++i) {
      const double x_m = coordinate(random) - 2.5;
      points.push_back({Vector2d(x_m, coordinate(random) - 2.5)});
    }
    window.center = Pose2(2.5, 2.5, 0.3);
    window.range_m = kReach_m;
    window.turn_rad = 0.2;
    window.independent_share = 1.0;
  }

  static GridGeometry geometry() {
    GridGeometry geometry;
    geometry.cell_m = 0.05;
    geometry.width = 101;
    geometry.height = 100;
    return geometry;
  }

  DistanceField walls{geometry()};
  std::vector<SurfacePoint> points;
  SearchWindow window;
};

/// Likelihood of the likeliest map cell in the raster's cell that holds a point.
double likelihood_at(const Scene& scene, const Cell& coarse) {
  double most = 0.0;
  for (int i = 0; i < WallRaster::kCoarser * WallRaster::kCoarser; ++i) {
    const Cell fine{coarse.x * WallRaster::kCoarser + i % WallRaster::kCoarser,
                    coarse.y * WallRaster::kCoarser + i / WallRaster::kCoarser};
    const std::uint8_t squared = scene.walls.squared_cells(fine);
    if (squared < DistanceField::kFar) {
      const double cells = kSigma_m / scene.walls.geometry().cell_m;
      most = std::max(most, std::round(255.0 * std::exp(-0.5 * squared / (cells * cells))) / 255.0);
    }
  }
  return most;
}

/// The best value of the window, by looking at every pose of the raster.
double best_by_hand(const Scene& scene) {
  const SearchWindow& window = scene.window;
  const double cell_m = WallRaster::kCoarser * scene.walls.geometry().cell_m;
  double farthest_m = 1.0;
  for (const SurfacePoint& point : scene.points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  const int angles = static_cast<int>(std::ceil(window.turn_rad * farthest_m / cell_m));
  const int reach = static_cast<int>(std::ceil(window.range_m / cell_m));
  double best = -1e300;
  for (int a = -angles; a <= angles; ++a) {
    const double turn_rad = a * window.turn_rad / angles;
    const Pose2 turned(window.center.translation(), window.center.theta() + turn_rad);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        double sum = 0.0;
        for (const SurfacePoint& point : scene.points) {
          const Vector2d p = turned * point.p / cell_m;
          sum += likelihood_at(scene, {static_cast<int>(std::floor(p.x())) + x,
                                       static_cast<int>(std::floor(p.y())) + y});
        }
        const double off = (x * x + y * y) * cell_m * cell_m / (window.sigma_m * window.sigma_m) +
                           turn_rad * turn_rad / (window.sigma_rad * window.sigma_rad);
        best = std::max(best, 2.0 * sum - 0.5 * off);
      }
    }
  }
  return best;
}

double value_of(const Scene& scene, const SearchResult& found) {
  const SearchWindow& window = scene.window;
  const Vector2d off = found.pose.translation() - window.center.translation();
  const double turn_rad = turn_between(window.center.theta(), found.pose.theta());
  return 2.0 * found.score * static_cast<double>(scene.points.size()) -
         0.5 * (off.squaredNorm() / (window.sigma_m * window.sigma_m) +
                turn_rad * turn_rad / (window.sigma_rad * window.sigma_rad));
}

TEST(WallRaster, FindsTheBestPoseOfItsWindowAsLookingAtAllOfThemDoes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed);
    if (seed % 2 == 1) {  // The centre is believed in.
      scene.window.sigma_m = 0.3;
      scene.window.sigma_rad = 0.1;
    }
    const WallRaster raster(scene.walls, kSigma_m, kReach_m);
    EXPECT_NEAR(value_of(scene, raster.find(scene.points, scene.window)), best_by_hand(scene),
                1e-9);
  }
}

TEST(WallRaster, FindsTheSameWhicheverReachItWasMadeFor) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene(seed);
    const SearchResult found =
        WallRaster(scene.walls, kSigma_m, kReach_m).find(scene.points, scene.window);
    const SearchResult again =
        WallRaster(scene.walls, kSigma_m, 3.0 * kReach_m).find(scene.points, scene.window);
    EXPECT_EQ(found.score, again.score);
    EXPECT_LT((found.pose.translation() - again.pose.translation()).norm(), 1e-9);
  }
}

TEST(WallRaster, StaysAtTheCenterWhereThereAreNoWallsOrTheyAreOutOfReach) {
  const Scene scene(1);
  const WallRaster empty(DistanceField(Scene::geometry()), kSigma_m, kReach_m);
  EXPECT_EQ(empty.find(scene.points, scene.window).pose, scene.window.center);
  EXPECT_EQ(empty.find(scene.points, scene.window).score, 0.0);
  SearchWindow far = scene.window;
  far.center = Pose2(1e6, -1e6, 2.0);
  const SearchResult found = WallRaster(scene.walls, kSigma_m, kReach_m).find(scene.points, far);
  EXPECT_EQ(found.pose, far.center);
  EXPECT_EQ(found.score, 0.0);
}

TEST(WallRaster, OfNothingFindsNothing) {
  const Scene scene(1);
  const WallRaster nothing(DistanceField(GridGeometry{}), kSigma_m, kReach_m);
  EXPECT_EQ(nothing.find(scene.points, scene.window).score, 0.0);
  const WallRaster raster(scene.walls, kSigma_m, kReach_m);
  EXPECT_EQ(raster.find({}, scene.window).pose, scene.window.center);
}

}  // namespace
}  // namespace cairn
