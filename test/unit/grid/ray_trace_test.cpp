#include "grid/ray_trace.hpp"

#include <cstdlib>
#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

GridGeometry ten_by_ten() {
  GridGeometry geometry;
  geometry.cell_m = 0.5;
  geometry.origin_m = Vector2d(-1.0, -1.0);
  geometry.width = 10;
  geometry.height = 10;
  return geometry;
}

std::vector<Cell> cells_of_ray(const Vector2d& from, const Vector2d& to) {
  std::vector<Cell> cells;
  trace_ray(ten_by_ten(), from, to, &cells);
  return cells;
}

TEST(RayTrace, WalksFromTheCellOfOneEndToThatOfTheOther) {
  EXPECT_THAT(cells_of_ray({0.2, 0.2}, {1.3, 0.2}),
              ElementsAre(Cell{2, 2}, Cell{3, 2}, Cell{4, 2}));
  EXPECT_THAT(cells_of_ray({0.2, 1.3}, {0.2, 0.2}),
              ElementsAre(Cell{2, 4}, Cell{2, 3}, Cell{2, 2}));
}

TEST(RayTrace, OfAPointIsItsCell) {
  EXPECT_THAT(cells_of_ray({0.2, 0.2}, {0.2, 0.2}), ElementsAre(Cell{2, 2}));
}

TEST(RayTrace, LeavesOutWhatLiesOutsideOfTheGrid) {
  EXPECT_THAT(cells_of_ray({-5.0, 0.2}, {-0.3, 0.2}), ElementsAre(Cell{0, 2}, Cell{1, 2}));
  EXPECT_THAT(cells_of_ray({3.7, 0.2}, {1e9, 0.2}), ElementsAre(Cell{9, 2}));
  EXPECT_THAT(cells_of_ray({-5.0, 9.0}, {5.0, 9.0}), IsEmpty());
  EXPECT_THAT(cells_of_ray({-9.0, 0.0}, {0.0, 12.0}), IsEmpty());
}

TEST(RayTrace, TakesConnectedCellsThatTheSegmentMeets) {
  const GridGeometry geometry = ten_by_ten();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-3.0, 6.0);
  for (int ray = 0; ray < 500; ++ray) {
    SCOPED_TRACE(ray);
    const Vector2d from(coordinate(random), coordinate(random));
    const Vector2d to(coordinate(random), coordinate(random));
    std::vector<Cell> cells;
    trace_ray(geometry, from, to, &cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_TRUE(geometry.contains(cells[i]));
      const Vector2d middle = geometry.center_of(cells[i]);
      const Vector2d way = (to - from).normalized();
      const double aside = std::abs(way.x() * (middle - from).y() - way.y() * (middle - from).x());
      EXPECT_LT(aside, 0.51 * geometry.cell_m * 1.4143);
      if (i > 0) {
        EXPECT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1);
      }
    }
    if (geometry.contains(geometry.cell_at(from)) && geometry.contains(geometry.cell_at(to))) {
      ASSERT_FALSE(cells.empty());
      EXPECT_EQ(cells.front(), geometry.cell_at(from));
      EXPECT_EQ(cells.back(), geometry.cell_at(to));
    }
  }
}

}  // namespace
}  // namespace cairn
