// What is promised of searches that look at stars of four slots only, on random walks in grids.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/lab/truth.hpp"
#include "bench/lab/worlds/random_world.hpp"
#include "exact_search/exact_search.hpp"
#include "star/isomorphism.hpp"
#include "support/obvious_tree.hpp"
#include "support/search_options.hpp"

namespace cairn::test {
namespace {

using lab::Walk;

/// A random walk in a grid of 2 to 4 rows and columns; long enough to see all of a small one.
Walk grid_walk(unsigned seed) {
  const lab::GridWorld grid =
      lab::grid_world(2 + static_cast<int>(seed % 3), 2 + static_cast<int>(seed / 3 % 2));
  lab::RandomWalkOptions options;
  options.travels = 10 + static_cast<int>(seed % 15);
  options.turning_back_probability = 0.0;
  options.exploring_probability = 1.0;
  return lab::random_walk(grid.world, options, seed);
}

int corner_count(const ObviousMap& map) {
  return static_cast<int>(
      std::count_if(map.places.begin(), map.places.end(),
                    [](const ObviousPlace& place) { return type_name(place.star) == "L"; }));
}

/// Closed maps in the plane that are perpendicular.
std::vector<ObviousMap> closed_perpendicular(const Walk& walk) {
  std::vector<ObviousMap> maps = obvious_tree(walk.exploration, {true, false, {}}).leaves;
  std::erase_if(maps,
                [](const ObviousMap& map) { return !is_closed(map) || !is_perpendicular(map); });
  return maps;
}

ExactSearchOptions planar_perpendicular() {
  ExactSearchOptions options = all_codes({true, false, {}});
  options.perpendicular = true;
  return options;
}

TEST(GridGuarantee, PerpendicularityPrunedEarlyIsPerpendicularityFilteredLate) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = grid_walk(seed);
    for (const bool planar : {false, true}) {
      ExactSearchOptions options = all_codes({planar, false, {}});
      const MapCounts late = enumerate(walk.exploration, options).counts;
      options.perpendicular = true;
      const MapCounts early = enumerate(walk.exploration, options).counts;
      EXPECT_EQ(early.closed_paper, late.perpendicular_closed_paper);
    }
  }
}

TEST(GridGuarantee, TheBoundOfCornersLosesNoClosedMapOfSoManyCorners) {
  std::int64_t closed = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = grid_walk(seed);
    const std::vector<ObviousMap> maps = closed_perpendicular(walk);
    for (int most = 3; most <= 8; ++most) {
      ExactSearchOptions options = planar_perpendicular();
      options.max_corners = most;
      const MapCounts counts = enumerate(walk.exploration, options).counts;
      const auto expected = std::count_if(maps.begin(), maps.end(), [most](const ObviousMap& map) {
        return corner_count(map) <= most;
      });
      EXPECT_EQ(counts.closed_no_pending, expected) << "at most " << most << " corners";
      closed += expected;
    }
  }
  EXPECT_GT(closed, 100);
}

TEST(GridGuarantee, TheFirstClosedMapByCornersHasTheFewestCornersThenPlaces) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = grid_walk(seed);
    using Size = std::pair<int, int>;
    std::optional<Size> by_corners;
    std::optional<Size> by_paths;
    for (const ObviousMap& map : closed_perpendicular(walk)) {
      const auto places = static_cast<int>(map.places.size());
      const Size corners(corner_count(map), places);
      const Size paths(static_cast<int>(places_of_paths(map).size()), places);
      by_corners = std::min(corners, by_corners.value_or(corners));
      by_paths = std::min(paths, by_paths.value_or(paths));
    }
    const ExactSearchOptions options = planar_perpendicular();
    const BestMap corners = find_best(walk.exploration, options, SearchOrder::kCorners);
    const BestMap paths = find_best(walk.exploration, options, SearchOrder::kPathsWithCorners);
    ASSERT_EQ(corners.map.has_value(), by_corners.has_value());
    ASSERT_EQ(paths.map.has_value(), by_paths.has_value());
    if (by_corners) {
      const std::string& code = corners.code;
      EXPECT_EQ(Size(std::count(code.begin(), code.end(), 'L'), corners.map->place_count()),
                *by_corners);
      EXPECT_EQ(Size(paths.map->path_count(), paths.map->place_count()), *by_paths);
    }
  }
}

TEST(GridGuarantee, StraightCorridorsAndACompassKeepTheTrueMapOfAGrid) {
  for (const auto& [rows, columns] : {std::pair(2, 2), {2, 3}, {3, 3}, {3, 4}, {4, 4}}) {
    SCOPED_TRACE(std::to_string(rows) + "x" + std::to_string(columns));
    const lab::GridWorld grid = lab::grid_world(rows, columns);
    const Walk walk = *lab::walk_grid(grid, 0, lab::snake_moves(rows, columns));
    for (const bool compass : {false, true}) {
      ExactSearchOptions options = planar_perpendicular();
      (compass ? options.compass : options.straight_corridors) = true;
      const MapCounts counts = enumerate(walk.exploration, options).counts;
      ASSERT_TRUE(counts.optimal);
      EXPECT_EQ(counts.optimal->codes, std::vector{lab::code_of_truth(walk)});
    }
  }
}

}  // namespace
}  // namespace cairn::test
