// Best-first search and iterative deepening.

#include <gmock/gmock.h>

#include "exact_search/exact_search.hpp"
#include "support/explorations.hpp"
#include "support/stars.hpp"
#include "topology/regions.hpp"
#include "walks.hpp"

namespace cairn {
namespace {

using test::planar;
using test::random_walk;

// The least map by enumeration, against the first one by each order.
TEST(BestMap, IsTheLeastOfItsOrder) {
  int closed = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Exploration exploration = seed < 3 ? test::snake(3, 2 + static_cast<int>(seed))
                                             : test::exploration_of(random_walk(seed, 2, 3, 16));
    ExactSearchOptions options = planar();
    options.region_consistent = true;
    const MapCounts all = enumerate(exploration, options).counts;
    const BestMap fewest_paths = find_best(exploration, options, SearchOrder::kPaths);
    EXPECT_TRUE(fewest_paths.is_proven);
    ASSERT_EQ(fewest_paths.map.has_value(), all.optimal.has_value());
    if (!all.optimal) {
      continue;
    }
    ++closed;
    EXPECT_EQ(fewest_paths.map->path_count(), all.optimal->paths);
    EXPECT_EQ(fewest_paths.map->place_count(), all.optimal->places);
    EXPECT_THAT(all.optimal->codes, ::testing::Contains(fewest_paths.code));
    const BestMap fewest_places = find_best(exploration, options, SearchOrder::kPlaces);
    options.max_places = fewest_places.map->place_count();
    EXPECT_GT(enumerate(exploration, options).counts.closed_no_pending, 0);
    options.max_places = *options.max_places - 1;
    EXPECT_EQ(enumerate(exploration, options).counts.closed_no_pending, 0);
  }
  EXPECT_GT(closed, 5);
}

TEST(BestMap, OrdersThatCountCornersFindTheGrid) {
  for (const int size : {3, 4, 5, 7}) {
    const Exploration grid = test::snake(size, size);
    const BestMap best = find_best(grid, planar(true), SearchOrder::kCorners);
    EXPECT_EQ(best.map->place_count(), size * size);
    EXPECT_TRUE(is_perpendicular(*best.map));
    EXPECT_EQ(best.code, canonical_code(*best.map));
    if (size < 6) {
      EXPECT_EQ(find_best(grid, planar(true), SearchOrder::kPathsWithCorners).code, best.code);
    }
  }
}

// 264 travels: long enough for iterative deepening, short enough for best-first search.
TEST(BestMap, IterativeDeepeningFindsTheMapOfBestFirstSearch) {
  const Exploration grid = test::snake(12, 12);
  ExactSearchOptions options = planar(true);
  options.compass = true;
  const BestMap best_first = find_best(grid, options, SearchOrder::kCorners);
  options.look_ahead = true;
  const BestMap deepened = find_best(grid, options, SearchOrder::kCorners);
  EXPECT_GT(best_first.bytes_per_node, 0U);
  EXPECT_GT(best_first.stored_nodes, 0);
  EXPECT_LE(best_first.stored_nodes, best_first.tree_nodes);
  EXPECT_EQ(deepened.stored_nodes, 0);
  EXPECT_EQ(deepened.code, best_first.code);
  EXPECT_TRUE(deepened.is_proven);
  EXPECT_EQ(deepened.map->place_count(), 144);
}

TEST(BestMap, ASearchThatIsCutOffProvesNothing) {
  ExactSearchOptions options = planar(true);
  options.max_nodes = 100;
  const BestMap best = find_best(test::snake(6, 6), options, SearchOrder::kPlaces);
  EXPECT_FALSE(best.map.has_value());
  EXPECT_FALSE(best.is_proven);
}

TEST(BestMap, ASearchThatNeedsJustAsManyNodesAsAllowedFinds) {
  for (const bool deepens : {false, true}) {
    SCOPED_TRACE(deepens);
    const Exploration grid = deepens ? test::snake(12, 12) : test::snake(5, 5);
    ExactSearchOptions options = planar(true);
    options.look_ahead = deepens;
    options.compass = deepens;
    const SearchOrder order = SearchOrder::kCorners;
    options.max_nodes = find_best(grid, options, order).tree_nodes;
    const BestMap found = find_best(grid, options, order);
    EXPECT_TRUE(found.is_complete);
    EXPECT_TRUE(found.is_proven);
    EXPECT_TRUE(found.map.has_value());
    --options.max_nodes;
    const BestMap cut_off = find_best(grid, options, order);
    EXPECT_FALSE(cut_off.is_complete);
    EXPECT_FALSE(cut_off.is_proven);
    EXPECT_EQ(cut_off.tree_nodes, options.max_nodes);
  }
}

TEST(BestMap, ThatThereIsNoneIsProven) {
  const BestMap best =
      find_best({test::crossing(), 0, {{1, test::tee(), 0}}}, {}, SearchOrder::kPlaces);
  EXPECT_FALSE(best.map.has_value());
  EXPECT_TRUE(best.is_proven);
}

}  // namespace
}  // namespace cairn
