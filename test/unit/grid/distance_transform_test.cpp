#include "grid/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::grid_of;

OccupancyGrid random_grid(unsigned seed) {
  std::mt19937 random(seed);
  GridGeometry geometry;
  geometry.width = 1 + static_cast<int>(random() % 40);
  geometry.height = 1 + static_cast<int>(random() % 40);
  const auto sparseness = 2 + random() % 60;
  OccupancyGrid grid(geometry);
  for (OccupancyGrid::LogOdds& cell : grid.cells()) {
    const auto draw = random() % sparseness;
    cell = draw == 0 ? OccupancyGrid::LogOdds{300} : OccupancyGrid::LogOdds{-300};
    cell = draw == 1 ? OccupancyGrid::LogOdds{0} : cell;
  }
  return grid;
}

int squared_distance(Cell a, Cell b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

std::int32_t by_looking_everywhere(const OccupancyGrid& grid, const GridWindow& window, Cell c) {
  std::int32_t least = DistanceTransform::kUnbounded;
  for (int y = window.lower.y; y < window.lower.y + window.height; ++y) {
    for (int x = window.lower.x; x < window.lower.x + window.width; ++x) {
      if (grid.state({x, y}) != CellState::kFree) {
        least = std::min(least, squared_distance({x, y}, c));
      }
    }
  }
  return least;
}

TEST(DistanceTransform, IsExactAndNamesACellAtThatDistance) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyGrid grid = random_grid(seed);
    const GridWindow window{{static_cast<int>(seed % 5), static_cast<int>(seed % 3)}, 30, 50};
    const DistanceTransform transform = distance_transform(grid, window);
    const GridWindow& used = transform.window();
    for (int y = used.lower.y; y < used.lower.y + used.height; ++y) {
      for (int x = used.lower.x; x < used.lower.x + used.width; ++x) {
        const Cell c{x, y};
        const std::int32_t squared = transform.squared_clearance_cells(c);
        ASSERT_EQ(squared, by_looking_everywhere(grid, used, c));
        if (squared != DistanceTransform::kUnbounded) {
          ASSERT_EQ(squared_distance(transform.basis_point(c), c), squared);
          ASSERT_NE(grid.state(transform.basis_point(c)), CellState::kFree);
        }
      }
    }
  }
}

TEST(DistanceTransform, UnknownBoundsFreeSpaceAndCanBeToldFromAWall) {
  const DistanceTransform transform = distance_transform(grid_of({"?....#"}, 0.5));
  EXPECT_DOUBLE_EQ(transform.clearance_m({1, 0}), 0.5);
  EXPECT_EQ(transform.state(transform.basis_point({1, 0})), CellState::kUnknown);
  EXPECT_EQ(transform.state(transform.basis_point({4, 0})), CellState::kOccupied);
}

TEST(DistanceTransform, TheBorderBoundsNothing) {
  const DistanceTransform transform = distance_transform(grid_of({"...", "..."}, 0.5));
  EXPECT_TRUE(std::isinf(transform.clearance_m({1, 1})));
  EXPECT_EQ(transform.basis_point({1, 1}), (Cell{1, 1}));
}

TEST(DistanceTransform, OfNoCellsIsEmpty) {
  const DistanceTransform transform =
      distance_transform(grid_of({"..."}, 0.5), GridWindow{{7, 7}, 3, 3});
  EXPECT_EQ(transform.window().width, 0);
  EXPECT_EQ(transform.clearance_m({7, 7}), 0.0);
}

}  // namespace
}  // namespace cairn
