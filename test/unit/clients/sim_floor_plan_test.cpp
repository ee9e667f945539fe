#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "clients/sim/floor_plan.hpp"
#include "clients/sim/random_source.hpp"

namespace cairn::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Free inside, with walls scattered over it.
FloorPlan random_plan(RandomSource& random, int side, double cell_m) {
  FloorPlan plan(side, side, cell_m);
  for (int row = 1; row + 1 < side; ++row) {
    for (int column = 1; column + 1 < side; ++column) {
      if (random.uniform() > 0.1) {
        plan.set_free({column, row});
      }
    }
  }
  return plan;
}

/// Walks along the ray in steps of a tenth of a millimetre.
double marched_ray_m(const FloorPlan& plan, Point origin, double direction_rad, double limit_m) {
  for (double along_m = 0.0; along_m <= limit_m; along_m += 1e-4) {
    const Point here = {origin.x_m + along_m * std::cos(direction_rad),
                        origin.y_m + along_m * std::sin(direction_rad)};
    if (plan.is_wall(plan.cell_of(here))) {
      return along_m;
    }
  }
  return kInfinity;
}

/// The ray against the square of every wall.
double slab_ray_m(const FloorPlan& plan, Point origin, double direction_rad) {
  const double dx = std::cos(direction_rad);
  const double dy = std::sin(direction_rad);
  double nearest_m = kInfinity;
  for (int row = 0; row < plan.rows(); ++row) {
    for (int column = 0; column < plan.columns(); ++column) {
      if (!plan.is_wall({column, row})) {
        continue;
      }
      const double x0 = (column * plan.cell_m() - origin.x_m) / dx;
      const double x1 = ((column + 1) * plan.cell_m() - origin.x_m) / dx;
      const double y0 = (row * plan.cell_m() - origin.y_m) / dy;
      const double y1 = ((row + 1) * plan.cell_m() - origin.y_m) / dy;
      const double enter_m = std::max(std::min(x0, x1), std::min(y0, y1));
      const double leave_m = std::min(std::max(x0, x1), std::max(y0, y1));
      if (enter_m <= leave_m && leave_m >= 0.0) {
        nearest_m = std::min(nearest_m, std::max(0.0, enter_m));
      }
    }
  }
  return nearest_m;
}

TEST(CastRay, StopsAtTheFaceOfTheWall) {
  FloorPlan plan(10, 3, 0.5);
  for (int column = 1; column < 9; ++column) {
    plan.set_free({column, 1});
  }
  EXPECT_DOUBLE_EQ(cast_ray_m(plan, {0.75, 0.75}, 0.0, 12.0), 3.75);
  EXPECT_DOUBLE_EQ(cast_ray_m(plan, {0.75, 0.75}, std::numbers::pi, 12.0), 0.25);
  EXPECT_DOUBLE_EQ(cast_ray_m(plan, {0.75, 0.75}, std::numbers::pi / 2.0, 12.0), 0.25);
}

TEST(CastRay, HasNoReturnBeyondTheRange) {
  FloorPlan plan(10, 3, 0.5);
  for (int column = 1; column < 9; ++column) {
    plan.set_free({column, 1});
  }
  EXPECT_EQ(cast_ray_m(plan, {0.75, 0.75}, 0.0, 3.7), kInfinity);
  EXPECT_DOUBLE_EQ(cast_ray_m(plan, {0.75, 0.75}, 0.0, 3.75), 3.75);
}

TEST(CastRay, IsZeroInsideAWallAndOutsideOfThePlan) {
  const FloorPlan plan(4, 4, 1.0);
  EXPECT_EQ(cast_ray_m(plan, {1.5, 1.5}, 0.3, 10.0), 0.0);
  EXPECT_EQ(cast_ray_m(plan, {-1e12, 1e12}, 0.3, 10.0), 0.0);
}

TEST(CastRay, AgreesWithEveryWallsSquareAndWithMarching) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    RandomSource random(seed, 0);
    const FloorPlan plan = random_plan(random, 24, 0.25);
    const Point origin = {1.0 + 4.0 * random.uniform(), 1.0 + 4.0 * random.uniform()};
    for (int ray = 0; ray < 20; ++ray) {
      const double direction_rad = 2.0 * std::numbers::pi * random.uniform();
      const double cast_m = cast_ray_m(plan, origin, direction_rad, 100.0);
      EXPECT_NEAR(cast_m, slab_ray_m(plan, origin, direction_rad), 1e-9);
    }
    const double cast_m = cast_ray_m(plan, origin, 1.0, 100.0);
    EXPECT_NEAR(cast_m, marched_ray_m(plan, origin, 1.0, 100.0), 2e-3);
  }
}

TEST(Clearance, IsTheDistanceToTheNearestWallUpToTheLimit) {
  FloorPlan plan(10, 10, 0.5);
  for (int row = 1; row < 9; ++row) {
    for (int column = 1; column < 9; ++column) {
      plan.set_free({column, row});
    }
  }
  EXPECT_DOUBLE_EQ(clearance_m(plan, {1.25, 2.5}, 2.0), 0.75);
  EXPECT_DOUBLE_EQ(clearance_m(plan, {2.5, 2.5}, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(clearance_m(plan, {0.25, 2.5}, 1.0), 0.0);
}

TEST(RandomSource, NormalsHaveMeanZeroAndVarianceOne) {
  RandomSource random(7, 3);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(squares / kCount, 1.0, 0.02);
}

TEST(RandomSource, StreamsOfOneSeedDiffer) {
  RandomSource laser(7, 1);
  RandomSource odometer(7, 2);
  EXPECT_NE(laser.uniform(), odometer.uniform());
}

}  // namespace
}  // namespace cairn::sim
