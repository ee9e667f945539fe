#include "grid/grid_search.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::grid_of;

GridSearchOptions point_robot() {
  GridSearchOptions options;
  options.robot_radius_m = 0.0;
  options.wall_cost = 0.0;
  return options;
}

OccupancyGrid random_grid(unsigned seed, int size) {
  std::mt19937 random(seed);
  std::vector<std::string> lines(static_cast<std::size_t>(size));
  for (std::string& line : lines) {
    for (int x = 0; x < size; ++x) {
      line += random() % 4 == 0 ? '#' : random() % 20 == 0 ? '?' : '.';
    }
  }
  return grid_of(lines, 0.1);
}

/// Length of the shortest way to every cell by relaxation until nothing changes: the oracle.
std::vector<double> costs_by_relaxation(const GridSearch& search, Cell from) {
  const GridGeometry& geometry = search.geometry();
  std::vector<double> cost(geometry.cell_count(), std::numeric_limits<double>::infinity());
  cost[geometry.index_of(from)] = 0.0;
  bool is_changed = true;
  while (is_changed) {
    is_changed = false;
    for (int i = 0; i < geometry.width * geometry.height * 9; ++i) {
      const Cell a{i / 9 % geometry.width, i / 9 / geometry.width};
      const Cell b{a.x + i % 3 - 1, a.y + i / 3 % 3 - 1};
      if (!search.is_traversable(a) || !search.is_traversable(b) ||
          !search.is_traversable({a.x, b.y}) || !search.is_traversable({b.x, a.y})) {
        continue;
      }
      const double length = a.x != b.x && a.y != b.y ? 17.0 / 12.0 : a == b ? 0.0 : 1.0;
      const double candidate = cost[geometry.index_of(a)] + length * geometry.cell_m;
      if (candidate < cost[geometry.index_of(b)] - 1e-9) {
        cost[geometry.index_of(b)] = candidate;
        is_changed = true;
      }
    }
  }
  return cost;
}

TEST(GridSearch, GoesStraightInTheOpen) {
  GridSearch search(grid_of({"......", "......", "......"}, 0.5), point_robot());
  const Result<GridPath> path = search.find_path({0, 1}, {5, 1});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells.size(), 6U);
  EXPECT_DOUBLE_EQ(path->length_m, 2.5);
  EXPECT_DOUBLE_EQ(path->cost_m, 2.5);
}

TEST(GridSearch, FindsTheCheapestWayOrNone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    GridSearch search(random_grid(seed, 14), point_robot());
    std::mt19937 random(seed);
    const auto any_cell = [&] {
      return Cell{static_cast<int>(random() % 14), static_cast<int>(random() % 14)};
    };
    const Cell from = any_cell();
    const std::vector<double> costs = costs_by_relaxation(search, from);
    for (int i = 0; i < 20; ++i) {
      const Cell to = any_cell();
      const Result<GridPath> path = search.find_path(from, to);
      const double expected = search.is_traversable(from) ? costs[search.geometry().index_of(to)]
                                                          : std::numeric_limits<double>::infinity();
      ASSERT_EQ(path.ok(), std::isfinite(expected) && search.is_traversable(to));
      if (path) {
        EXPECT_NEAR(path->cost_m, expected, 1e-6);
      }
    }
  }
}

TEST(GridSearch, StepsAreBetweenNeighborsAndCutNoCorner) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    GridSearch search(random_grid(seed, 20), point_robot());
    const Result<GridPath> path = search.find_path({0, 0}, {19, 19});
    for (std::size_t i = 1; path && i < path->cells.size(); ++i) {
      const Cell a = path->cells[i - 1];
      const Cell b = path->cells[i];
      EXPECT_LE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);
      EXPECT_TRUE(search.is_traversable({a.x, b.y}));
      EXPECT_TRUE(search.is_traversable({b.x, a.y}));
    }
  }
}

TEST(GridSearch, KeepsToTheMiddleOfACorridor) {
  const OccupancyGrid corridor = grid_of({"##############",  //
                                          "..............",  //
                                          "..............",  //
                                          "..............",  //
                                          "..............",  //
                                          "..............",  //
                                          "##############"},
                                         0.1);
  GridSearchOptions options;
  options.robot_radius_m = 0.1;
  GridSearch search(corridor, options);
  const Result<GridPath> path = search.find_path({0, 1}, {13, 1});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells[7].y, 3);
  EXPECT_GT(path->cost_m, path->length_m);
}

TEST(GridSearch, ADoorIsPassedOnlyByARobotThatFits) {
  const OccupancyGrid door = grid_of({".....#.....",  //
                                      ".....#.....",  //
                                      "...........",  //
                                      "...........",  //
                                      "...........",  //
                                      ".....#.....",  //
                                      ".....#....."},
                                     0.1);
  GridSearchOptions options;
  options.robot_radius_m = 0.2;
  GridSearch slim(door, options);
  EXPECT_TRUE(slim.find_path({0, 3}, {10, 3}));
  options.robot_radius_m = 0.25;
  GridSearch wide(door, options);
  const Result<GridPath> path = wide.find_path({0, 3}, {10, 3});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ErrorCode::kNotFound);
}

TEST(GridSearch, UnknownCellsAreBarredUnlessAllowedAndAreNoWalls) {
  const OccupancyGrid gap = grid_of({"..?..", "..?..", "..?.."}, 0.1);
  GridSearchOptions options = point_robot();
  GridSearch careful(gap, options);
  EXPECT_FALSE(careful.find_path({0, 1}, {4, 1}));
  EXPECT_DOUBLE_EQ(careful.clearance_m({1, 1}), 655.35);
  options.unknown_is_traversable = true;
  GridSearch bold(gap, options);
  EXPECT_TRUE(bold.find_path({0, 1}, {4, 1}));
}

TEST(GridSearch, MayBeKeptNearALine) {
  GridSearch search(grid_of({"........", ".######.", "........", "........"}, 0.1), point_robot());
  const Result<GridPath> near = search.find_path_near({{4, 3}}, 4, {0, 3}, {7, 3});
  ASSERT_TRUE(near);
  EXPECT_THAT(near->cells, ::testing::Contains(Cell{4, 3}));
  EXPECT_FALSE(search.find_path_near({}, 2, {0, 0}, {7, 0}));
  EXPECT_TRUE(search.find_path({0, 0}, {7, 0}));
}

TEST(GridSearch, NearEverythingIsTheSameAsAnywhere) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    GridSearch search(random_grid(seed, 20), point_robot());
    const Result<GridPath> near = search.find_path_near({{10, 10}}, 30, {0, 0}, {19, 19});
    const Result<GridPath> path = search.find_path({0, 0}, {19, 19});
    ASSERT_EQ(near.ok(), path.ok());
    if (path) {
      EXPECT_EQ(near->cells, path->cells);
    }
  }
}

TEST(GridSearch, LargerCellsShowAGapOfHalfTheirWidth) {
  const OccupancyGrid gap = grid_of({".....#......",  //
                                     ".....#......",  //
                                     ".....#......",  //
                                     ".....#......",  //
                                     ".....#......",  //
                                     "............",  //
                                     "............",  //
                                     ".....#......"},
                                    0.1);
  GridSearchOptions options = point_robot();
  GridSearch coarse = GridSearch(gap, options).coarsened(4);
  EXPECT_EQ(coarse.geometry().width, 3);
  EXPECT_EQ(coarse.geometry().height, 2);
  EXPECT_DOUBLE_EQ(coarse.geometry().cell_m, 0.4);
  EXPECT_TRUE(coarse.find_path({0, 0}, {2, 0}));
  options.robot_radius_m = 0.3;
  GridSearch wide = GridSearch(gap, options).coarsened(4);
  EXPECT_FALSE(wide.is_traversable({1, 0}));
}

TEST(GridSearch, ALineIsAsCheapAsTheWayAlongIt) {
  GridSearch search(grid_of({"....", "....", "..#."}, 0.1), point_robot());
  EXPECT_NEAR(search.line_cost_m({0, 2}, {3, 2}), 0.3, 1e-12);
  EXPECT_NEAR(search.line_cost_m({0, 0}, {0, 0}), 0.0, 1e-12);
  EXPECT_TRUE(std::isinf(search.line_cost_m({0, 0}, {3, 0})));
  EXPECT_TRUE(std::isinf(search.line_cost_m({0, 0}, {9, 0})));
}

TEST(GridSearch, EndsInWallsOrOffTheGridAreRefused) {
  GridSearch search(grid_of({"...#"}, 0.1), point_robot());
  for (const Cell bad : {Cell{3, 0}, Cell{-1, 0}, Cell{0, 7}}) {
    const Result<GridPath> path = search.find_path({0, 0}, bad);
    ASSERT_FALSE(path);
    EXPECT_EQ(path.error().code, ErrorCode::kInvalidValue);
    EXPECT_FALSE(search.find_path(bad, {0, 0}));
  }
}

TEST(GridSearch, FindsTheNearestPlaceToStand) {
  GridSearch search(grid_of({"###.", "####", ".###"}, 0.1), point_robot());
  const Result<Cell> nearest = search.nearest_traversable({1, 0}, 0.2);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(*nearest, (Cell{0, 0}));
  EXPECT_FALSE(search.nearest_traversable({1, 1}, 0.1));
  EXPECT_FALSE(search.nearest_traversable({500, 500}, 0.3));
}

TEST(GridSearch, OfAnEmptyGridFindsNothing) {
  GridSearch search(OccupancyGrid(GridGeometry{}), point_robot());
  EXPECT_FALSE(search.find_path({0, 0}, {0, 0}));
}

TEST(GridSearch, NamesBadOptions) {
  GridSearchOptions options;
  options.wall_cost = 15.0;
  EXPECT_FALSE(validate(options));
  options = {};
  options.robot_radius_m = NAN;
  EXPECT_FALSE(validate(options));
  EXPECT_TRUE(validate(GridSearchOptions{}));
}

}  // namespace
}  // namespace cairn
