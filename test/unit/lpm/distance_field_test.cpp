#include "lpm/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

constexpr int kSide = 60;

GridGeometry square() {
  GridGeometry geometry;
  geometry.cell_m = 0.1;
  geometry.width = kSide;
  geometry.height = kSide;
  return geometry;
}

std::uint8_t squared_by_hand(const OccupancyGrid& grid, Cell c) {
  int least = DistanceField::kFar;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (grid.state({x, y}) == CellState::kOccupied) {
        least = std::min(least, (x - c.x) * (x - c.x) + (y - c.y) * (y - c.y));
      }
    }
  }
  return static_cast<std::uint8_t>(least);
}

TEST(DistanceField, IsThatOfTheWallsHoweverTheyCameAndWent) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    OccupancyGrid grid(square());
    DistanceField field(square());
    for (int change = 0; change < 60; ++change) {
      const Cell c{static_cast<int>(random() % kSide), static_cast<int>(random() % kSide)};
      if (grid.state(c) == CellState::kOccupied) {
        grid.log_odds(c) = 0;
        field.renew(grid, c, c);
      } else {
        grid.log_odds(c) = 200;
        field.add_wall(c);
      }
    }
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        ASSERT_EQ(field.squared_cells({x, y}), squared_by_hand(grid, {x, y})) << x << " " << y;
      }
    }
  }
}

TEST(DistanceField, GivesDistancesBetweenCellsAndTheirGradient) {
  DistanceField field(square());
  for (int y = 0; y < kSide; ++y) {
    field.add_wall({20, y});
  }
  const DistanceField::Sample right = field.sample({2.05 + 0.33, 3.01});
  EXPECT_NEAR(right.distance_m, 0.33, 1e-9);
  EXPECT_NEAR(right.gradient.x(), 1.0, 1e-9);
  EXPECT_NEAR(right.gradient.y(), 0.0, 1e-9);
  EXPECT_TRUE(right.is_near);
  EXPECT_FALSE(field.sample({4.5, 3.0}).is_near);
  EXPECT_FALSE(field.sample({-100.0, 3.0}).is_near);
}

TEST(DistanceField, NamesNoWallThatTheWindowHasLeftBehind) {
  DistanceField field(square());
  field.add_wall({3, 30});
  field.shift({5, 0});
  Cell wall;
  EXPECT_FALSE(field.find_nearest({0, 30}, &wall));
}

TEST(DistanceField, ShiftsByWholeCells) {
  DistanceField field(square());
  field.add_wall({20, 30});
  field.shift({5, -3});
  EXPECT_EQ(field.squared_cells({15, 33}), 0);
  EXPECT_EQ(field.squared_cells({15, 34}), 1);
  EXPECT_NEAR(field.geometry().origin_m.x(), 0.5, 1e-12);
  EXPECT_NEAR(field.geometry().origin_m.y(), -0.3, 1e-12);
}

}  // namespace
}  // namespace cairn
