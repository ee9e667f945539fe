#include "exact_search/exact_search.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "support/explorations.hpp"
#include "support/stars.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/regions.hpp"
#include "walks.hpp"

namespace cairn {
namespace {

using test::planar;
using test::random_walk;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Enough corners for any map of the exploration.
int any_corners(const Exploration& exploration) {
  return static_cast<int>(exploration.steps.size()) + 1;
}

Exploration back_and_forth(int travels) {
  const ExplorationStep step{0, test::dead_end(), 0};
  return {test::dead_end(), 0,
          std::vector<ExplorationStep>(static_cast<std::size_t>(travels), step)};
}

TEST(Exploration, WhatIsImpossibleIsNamedWithItsStep) {
  Exploration exploration = test::snake(2, 2);
  EXPECT_TRUE(validate(exploration).ok());
  exploration.steps[2].turn = 2;
  EXPECT_THAT(validate(exploration).error().message, HasSubstr("step 2: turn must be in [0, 1]"));
  exploration = test::snake(2, 2);
  exploration.steps[1].arrival_gateway = -1;
  EXPECT_THAT(validate(exploration).error().message, HasSubstr("step 1: arrival_gateway"));
  exploration.steps[0].star.slots[0].partner = 9;
  EXPECT_THAT(validate(exploration).error().message, HasSubstr("step 0"));
  exploration.start_gateway = 7;
  EXPECT_THAT(validate(exploration).error().message, HasSubstr("start: start_gateway"));
  exploration.start.slots.clear();
  EXPECT_FALSE(validate(exploration).ok());
}

TEST(ExactSearchOptions, WhatDoesNotSuitTheExplorationIsRefused) {
  const Exploration grid = test::snake(2, 3);
  const auto refuses = [](const ExactSearchOptions& options, const Exploration& exploration) {
    return !validate(options, exploration).ok();
  };
  ExactSearchOptions options;
  EXPECT_FALSE(refuses(options, grid));
  options.max_corners = 4;
  EXPECT_TRUE(refuses(options, grid));
  options.planar = options.perpendicular = true;
  EXPECT_FALSE(refuses(options, grid));
  EXPECT_TRUE(refuses(options, back_and_forth(2)));
  EXPECT_FALSE(validate(planar(true), back_and_forth(2), SearchOrder::kCorners).ok());
  EXPECT_FALSE(validate({}, grid, SearchOrder::kPathsWithCorners).ok());
  EXPECT_TRUE(validate(planar(true), grid, SearchOrder::kPathsWithCorners).ok());
  ExactSearchOptions compass;
  compass.compass = true;
  EXPECT_TRUE(refuses(compass, back_and_forth(2)));
  ExactSearchOptions by_face;
  by_face.look_ahead_by_face = by_face.planar = true;
  EXPECT_TRUE(refuses(by_face, grid));
  ExactSearchOptions none;
  none.max_places = 0;
  EXPECT_TRUE(refuses(none, grid));
}

// The tree keeps its leaves as maps and asks each of them; the search carries everything along.
TEST(Enumeration, AgreesWithATreeThatKeepsItsLeaves) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const test::Walk walk = random_walk(seed, 3, 3, 13);
    TopologyOptions kept;
    kept.planar = seed % 2 == 0;
    kept.max_hypotheses = 1'000'000;
    HypothesisTree tree(kept);
    ASSERT_TRUE(tree.start(walk.start).ok());
    for (const test::Experienced& step : walk.steps) {
      ASSERT_TRUE(tree.extend(step.action, step.view).ok());
    }
    const auto count = [&](auto holds) {
      std::int64_t held = 0;
      tree.for_each_map(
          [&](const Hypothesis&, const TopologicalMap& map) { held += holds(map) ? 1 : 0; });
      return held;
    };
    ExactSearchOptions options;
    options.planar = kept.planar;
    const MapCounts counts = enumerate(test::exploration_of(walk), options).counts;
    EXPECT_EQ(counts.tree_nodes, tree.node_count());
    EXPECT_EQ(counts.final_maps, tree.live_count());
    EXPECT_EQ(counts.region_consistent_finals, count(is_region_consistent));
    EXPECT_EQ(counts.closed_paper,
              count([](const TopologicalMap& map) { return map.has_no_lone_path(); }));
    EXPECT_EQ(counts.perpendicular_closed_paper, count([](const TopologicalMap& map) {
                return map.has_no_lone_path() && is_perpendicular(map);
              }));
  }
}

TEST(Enumeration, NoTwoMapsAreTheSame) {
  ExactSearchOptions options;
  options.max_codes = 100'000;
  const MapCounts counts = enumerate(test::snake(3, 5), options).counts;
  ASSERT_EQ(counts.optimal->count, 48);
  const std::set<std::string> codes(counts.optimal->codes.begin(), counts.optimal->codes.end());
  EXPECT_EQ(codes.size(), 48U);
}

TEST(Enumeration, MoreCodesThanAskedForAreNotKept) {
  ExactSearchOptions options;
  options.max_codes = 47;
  EXPECT_THAT(enumerate(test::snake(3, 5), options).counts.optimal->codes, IsEmpty());
}

// What prunes in view of the end, and the bound on corners, lose nothing that is closed.
TEST(Enumeration, PruningInViewOfTheEndLosesNoClosedMap) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Exploration exploration = seed < 3 ? test::snake(3, 2 + static_cast<int>(seed))
                                             : test::exploration_of(random_walk(seed, 2, 3, 14));
    for (const bool perpendicular : {false, true}) {
      ExactSearchOptions options = planar(perpendicular);
      const MapCounts all = enumerate(exploration, options).counts;
      options.look_ahead = true;
      const MapCounts pruned = enumerate(exploration, options).counts;
      EXPECT_EQ(pruned.closed_no_pending, all.closed_no_pending);
      EXPECT_LE(pruned.tree_nodes, all.tree_nodes);
      options.look_ahead_by_face = true;
      const MapCounts by_face = enumerate(exploration, options).counts;
      EXPECT_EQ(by_face.closed_no_pending, all.closed_no_pending);
      EXPECT_LE(by_face.tree_nodes, pruned.tree_nodes);
      options.max_corners = any_corners(exploration);
      if (validate(options, exploration).ok()) {
        EXPECT_EQ(enumerate(exploration, options).counts.closed_no_pending, all.closed_no_pending);
      }
    }
  }
}

TEST(Enumeration, AtMostFourCornersAndACompassLeaveTheGridItself) {
  ExactSearchOptions options = planar(true);
  options.look_ahead = options.compass = true;
  options.max_corners = 4;
  for (const int size : {4, 5, 6, 8, 10}) {
    SCOPED_TRACE(size);
    const MapCounts counts = enumerate(test::snake(size, size), options).counts;
    EXPECT_EQ(counts.closed_no_pending, 1);
    EXPECT_EQ(counts.optimal->places, size * size);
    EXPECT_EQ(counts.optimal->paths, 2 * size);
  }
}

// Twisted faces make grids of an even side hard without a compass: 1.8 million nodes for this one.
TEST(Enumeration, LookingAheadByFaceFindsAGridOfEvenSideWithoutACompass) {
  ExactSearchOptions options = planar(true);
  options.look_ahead = options.look_ahead_by_face = true;
  options.max_corners = 4;
  const Enumeration found = enumerate(test::snake(8, 8), options);
  EXPECT_EQ(found.counts.closed_no_pending, 1);
  EXPECT_EQ(found.counts.optimal->places, 64);
  EXPECT_LT(found.counts.tree_nodes, 20'000);
}

// The bound of four corners makes every face a quadrangle, which must lose nothing either.
TEST(Enumeration, LookingAheadByFaceLosesNoMapOfFourCorners) {
  for (const auto& [rows, columns] :
       {std::pair(3, 3), {3, 5}, {5, 3}, {4, 5}, {5, 5}, {6, 6}, {5, 7}}) {
    SCOPED_TRACE(rows * 10 + columns);
    ExactSearchOptions options = planar(true);
    options.look_ahead = true;
    options.max_corners = 4;
    const MapCounts without = enumerate(test::snake(rows, columns), options).counts;
    options.look_ahead_by_face = true;
    const MapCounts with = enumerate(test::snake(rows, columns), options).counts;
    EXPECT_EQ(with.closed_no_pending, without.closed_no_pending);
    EXPECT_EQ(with.optimal->codes, without.optimal->codes);
  }
}

TEST(Enumeration, ASearchThatIsCutOffSaysSo) {
  ExactSearchOptions options;
  options.max_nodes = 1000;
  const Enumeration found = enumerate(test::snake(4, 4), options);
  EXPECT_FALSE(found.is_complete);
  EXPECT_EQ(found.counts.tree_nodes, 1000);
}

TEST(Enumeration, ATreeOfJustAsManyNodesAsAllowedIsComplete) {
  ExactSearchOptions options = planar();
  options.max_nodes = 240;
  EXPECT_TRUE(enumerate(test::snake(3, 3), options).is_complete);
  options.max_nodes = 239;
  EXPECT_FALSE(enumerate(test::snake(3, 3), options).is_complete);
}

TEST(Enumeration, ALongExperienceDoesNotExhaustTheStack) {
  const Enumeration found = enumerate(back_and_forth(200'000), {});
  EXPECT_EQ(found.counts.final_maps, 1);
  EXPECT_EQ(found.counts.tree_nodes, 200'001);
}

TEST(Enumeration, WithoutTravelsTheStartIsTheOnlyMap) {
  const MapCounts counts = enumerate({test::crossing(), 0, {}}, {}).counts;
  EXPECT_EQ(counts.tree_nodes, 1);
  EXPECT_EQ(counts.final_maps, 1);
  EXPECT_EQ(counts.closed_no_pending, 0);
  EXPECT_EQ(counts.minimal_region->paths, 2);
}

TEST(CanonicalCode, DoesNotDependOnWhereAStarsListBegins) {
  Exploration turned = test::snake(3, 3);
  for (ExplorationStep& step : turned.steps) {
    const std::size_t size = step.star.slots.size();
    if (step.star.slots.back().gateway >= 0) {
      continue;
    }
    // The terminated end comes first; gateways keep their numbers.
    std::rotate(step.star.slots.begin(), step.star.slots.end() - 1, step.star.slots.end());
    for (StarSlot& slot : step.star.slots) {
      slot.partner = (slot.partner + 1) % size;
    }
  }
  const MapCounts straight = enumerate(test::snake(3, 3), {}).counts;
  const MapCounts rotated = enumerate(turned, {}).counts;
  EXPECT_EQ(rotated.tree_nodes, straight.tree_nodes);
  EXPECT_EQ(rotated.optimal->codes, straight.optimal->codes);
}

}  // namespace
}  // namespace cairn
