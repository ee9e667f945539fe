#include "bench/lab/worlds/random_world.hpp"

#include <set>

#include <gtest/gtest.h>

#include "bench/lab/worlds/random_exploration.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {
namespace {

RandomWorldOptions options_of(unsigned seed) {
  RandomWorldOptions options;
  options.places = 1 + static_cast<int>(seed % 30);
  options.star_kinds = 1 + static_cast<int>(seed % 5);
  options.closing_probability = 0.1 * (seed % 10);
  return options;
}

TEST(RandomWorld, IsPlanarAndHasNoPlaceTwiceOnAPath) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const World world = random_world(options_of(seed), seed);
    EXPECT_TRUE(is_planar(world));
    EXPECT_TRUE(satisfies_axioms(world));
    EXPECT_GE(static_cast<int>(world.places.size()), options_of(seed).places);
  }
}

TEST(RandomWorld, HasStarsOfManyKinds) {
  std::set<std::string> kinds;
  for (unsigned seed = 0; seed < 300; ++seed) {
    for (const WorldPlace& place : random_world(options_of(seed), seed).places) {
      ASSERT_TRUE(validate(place.star));
      kinds.insert(type_name(place.star));
    }
  }
  for (const char* kind : {"D", "I", "L", "T", "+", "g3x3g3x3g3x3"}) {
    EXPECT_EQ(kinds.count(kind), 1U) << kind;
  }
  EXPECT_GT(kinds.size(), 20U);
}

TEST(RandomWorld, IsTheSameForTheSameSeed) {
  const World first = random_world({}, 7);
  const World again = random_world({}, 7);
  ASSERT_EQ(first.places.size(), again.places.size());
  for (std::size_t place = 0; place < first.places.size(); ++place) {
    EXPECT_EQ(first.places[place].star, again.places[place].star);
    EXPECT_EQ(first.places[place].leads_to, again.places[place].leads_to);
  }
}

TEST(RandomWalk, IsAValidExplorationThatSeesTheStarsOfItsPlaces) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const World world = random_world(options_of(seed), seed);
    const Walk walk = random_walk(world, {}, seed);
    ASSERT_TRUE(validate(walk.exploration));
    ASSERT_EQ(walk.visits.size(), walk.exploration.steps.size() + 1);
    for (std::size_t step = 0; step < walk.exploration.steps.size(); ++step) {
      const ExplorationStep& seen = walk.exploration.steps[step];
      const TrueVisit& visit = walk.visits[step + 1];
      const int arrival = visit.gateways[static_cast<std::size_t>(seen.arrival_gateway)];
      EXPECT_TRUE(are_alike(seen.star, seen.arrival_gateway,
                            world.places[static_cast<std::size_t>(visit.place)].star, arrival));
    }
  }
}

TEST(GridWorld, IsPlanarAndHasNoPlaceTwiceOnAPath) {
  for (const auto& [rows, columns] : {std::pair(1, 2), {5, 1}, {2, 2}, {3, 4}, {6, 5}}) {
    const GridWorld grid = grid_world(rows, columns);
    EXPECT_TRUE(is_planar(grid.world));
    EXPECT_TRUE(satisfies_axioms(grid.world));
  }
}

TEST(GridWorld, IsExploredRowByRowAndThenColumnByColumn) {
  EXPECT_EQ(snake_moves(3, 3), "EESWWSEENNWSSWNN");
  EXPECT_EQ(snake_moves(4, 4), "EEESWWWSEEESWWWNNNESSSENNNESSS");
  EXPECT_EQ(snake_moves(1, 3), "EE");
}

TEST(GridWorld, NamesTheMoveThatLeavesIt) {
  const Result<Walk> walk = walk_grid(grid_world(2, 2), 0, "ESE");
  ASSERT_FALSE(walk);
  EXPECT_EQ(walk.error().message,
            "move 3 ('E') leaves the grid of 2x2 from row 1, column 1 (counted from 0)");
  EXPECT_FALSE(walk_grid(grid_world(2, 2), 0, "Q"));
}

TEST(TrueSteps, NumberPlacesAsTheyAreMet) {
  const Result<Walk> walk = walk_grid(grid_world(2, 2), 3, "WNESW");
  ASSERT_TRUE(walk);
  std::vector<int> places;
  for (const TrueStep& step : truth_of(*walk)) {
    places.push_back(step.place);
  }
  EXPECT_EQ(places, (std::vector<int>{0, 1, 2, 3, 0, 1}));
}

}  // namespace
}  // namespace cairn::lab
