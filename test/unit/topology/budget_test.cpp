// What a tree does that may not keep all maps, or take all the time.

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "traveller.hpp"
#include "true_map.hpp"

namespace cairn::test {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TopologyOptions at_most(int hypotheses) {
  TopologyOptions options;
  options.max_hypotheses = hypotheses;
  return options;
}

void go(Traveller& robot, const Walk& walk, std::size_t first, std::size_t last) {
  for (std::size_t step = first; step < last; ++step) {
    robot.travel(walk.steps[step].action.turn, walk.steps[step].view);
  }
}

TEST(Budget, KeepsNoMoreThanItMayAndTheOthersWait) {
  const Walk walk = Lattice(3, 4).walk(0, "ESSENNESSWWWNEEENWWWS");
  for (const int most : {1, 7, 50}) {
    Traveller robot(walk.start.star, walk.start.arrival_gateway, at_most(most));
    for (const Experienced& step : walk.steps) {
      const ExtendReport report = robot.travel(step.action.turn, step.view);
      EXPECT_LE(report.leaves, most);
      EXPECT_EQ(report.leaves, robot.tree().live_count());
      EXPECT_EQ(report.waiting, robot.tree().waiting_count());
      EXPECT_EQ(report.dropped, 0);
    }
    EXPECT_GT(robot.tree().waiting_count(), 0);
    EXPECT_FALSE(robot.tree().guarantee_given_up());
  }
}

// The budget loses nothing: once it is raised by refutations, all maps that were found without a
// budget are there again.
TEST(Budget, WhatWaitsIsEverythingThatIsNotLive) {
  const Walk walk = Lattice(3, 3).walk(0, snake_moves(3, 3));
  TopologyOptions options = at_most(62);
  options.max_revivals = 1'000'000;
  Traveller robot(walk.start.star, walk.start.arrival_gateway, options);
  go(robot, walk, 0, walk.steps.size());
  EXPECT_EQ(robot.tree().live_count() + robot.tree().waiting_count(), 62);
  EXPECT_EQ(count_true_maps(robot.tree(), walk), 1);
}

TEST(Budget, TheTrueMapIsRevivedWhenEvidenceComesLate) {
  for (const int most : {1, 2, 3}) {
    SCOPED_TRACE(most);
    Evidence late;
    late.same_place = [](SeenGateway known, SeenGateway now) {
      const bool is_same = known.visit.value % 4 == now.visit.value % 4;
      return now.visit.value < 9 ? 0.0 : is_same ? 4.0 : -4.0;
    };
    Traveller robot = around_the_block(at_most(most), late);
    std::int64_t revived = 0;
    for (int visit = 5; visit < 24; ++visit) {
      revived += robot.travel(1, corner(), 1).revived;
      EXPECT_LE(robot.tree().live_count(), most);
    }
    EXPECT_GT(revived, 0);
    EXPECT_EQ(robot.best().place_count, 4);
    EXPECT_TRUE(robot.best_map().is_closed());
    EXPECT_FALSE(robot.tree().guarantee_given_up());
  }
}

TEST(Budget, OnARandomWalkTheTrueMapComesBackToTheTop) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Lattice streets(3, 3);
    const Walk walk = streets.walk(0, streets.random_moves(0, 60, random));
    Evidence late;
    late.same_place = [&](SeenGateway known, SeenGateway now) {
      const bool is_same =
          walk.truth[known.visit.index()].first == walk.truth[now.visit.index()].first &&
          known.gateway == now.gateway;
      return now.visit.value < 20 ? 0.0 : is_same ? 6.0 : -6.0;
    };
    Traveller robot(walk.start.star, walk.start.arrival_gateway, at_most(5), late);
    go(robot, walk, 0, walk.steps.size());
    EXPECT_TRUE(is_true_map(robot.best_map(), walk));
    EXPECT_FALSE(robot.tree().guarantee_given_up());
  }
}

TEST(Budget, AWaitingMapThatExplainsWhatRefutesTheLiveOnesLosesNoGuarantee) {
  Traveller robot = around_the_block(at_most(1));
  ASSERT_LT(robot.best().place_count, 4);
  // A left turn: only the chain of new places can explain it.
  const ExtendReport report = robot.travel(1, corner(), 0);
  ASSERT_TRUE(report.repair);
  EXPECT_TRUE(report.repair->is_explained);
  EXPECT_TRUE(report.repair->blamed.empty());
  EXPECT_FALSE(report.guarantee_given_up);
  EXPECT_EQ(robot.best().place_count, 6);
  EXPECT_EQ(robot.best().contradictions, 0);
}

TEST(Budget, MemoryIsKeptByGivingUpTheGuaranteeWithABound) {
  const Lattice streets(5, 5);
  std::mt19937 random(1);
  const Walk walk = streets.walk(0, streets.random_moves(0, 120, random));
  TopologyOptions options = at_most(100);
  options.planar = false;
  options.max_bytes = 200'000;
  Traveller robot(walk.start.star, walk.start.arrival_gateway, options);
  std::int64_t dropped = 0;
  for (const Experienced& step : walk.steps) {
    dropped += robot.travel(step.action.turn, step.view).dropped;
    const HypothesisTree::Memory memory = robot.tree().memory();
    ASSERT_LE(memory.bytes_of_nodes + memory.bytes_of_leaves, 200'000U);
  }
  EXPECT_GT(dropped, 0);
  EXPECT_GT(robot.tree().waiting_count(), 100) << "not all is given up at once";
  EXPECT_GT(robot.tree().live_count(), 0);
  const std::optional<GuaranteeGivenUp>& given_up = robot.tree().guarantee_given_up();
  ASSERT_TRUE(given_up);
  EXPECT_EQ(given_up->loss, GuaranteeLoss::kBudget);
  EXPECT_LE(given_up->log_posterior_bound, 0.0);
  EXPECT_TRUE(std::isfinite(given_up->log_posterior_bound));
  EXPECT_THAT(given_up->reason, HasSubstr("max_bytes is 200000"));
  EXPECT_TRUE(std::isfinite(robot.tree().proven_gap()));
}

TEST(Budget, EvenLiveMapsAreGivenUpBeforeMemoryIsExceeded) {
  const Lattice streets(4, 4);
  const Walk walk = streets.walk(0, snake_moves(4, 4));
  TopologyOptions options = at_most(100'000);
  options.max_bytes = 65'536;
  Traveller robot(walk.start.star, walk.start.arrival_gateway, options);
  for (const Experienced& step : walk.steps) {
    robot.travel(step.action.turn, step.view);
    const HypothesisTree::Memory memory = robot.tree().memory();
    ASSERT_LE(memory.bytes_of_nodes + memory.bytes_of_leaves, 65'536U);
    ASSERT_GT(robot.tree().live_count(), 0);
  }
  EXPECT_EQ(robot.tree().guarantee_given_up()->loss, GuaranteeLoss::kBudget);
}

TEST(Budget, ANodeTakesLessThan64Bytes) {
  EXPECT_LT(sizeof(TreeNode), 64U);
  const Walk walk = Lattice(3, 4).walk(0, snake_moves(3, 4));
  Traveller robot(walk.start.star, walk.start.arrival_gateway, at_most(100'000));
  for (const Experienced& step : walk.steps) {
    robot.travel(step.action.turn, step.view);
    const HypothesisTree::Memory memory = robot.tree().memory();
    ASSERT_LT(memory.bytes_of_nodes, 64 * memory.nodes);
  }
}

TEST(Budget, WhenTimeIsAlwaysUpTheTreeLivesOnAndTheOthersWaitUntilThereIsTime) {
  const Walk walk = Lattice(3, 3).walk(0, snake_moves(3, 3));
  TopologyOptions options = at_most(100'000);
  options.max_revivals = 1'000'000;
  HypothesisTree tree(options);
  ASSERT_TRUE(tree.start(walk.start).ok());
  std::int64_t waited = 0;
  for (std::size_t step = 0; step + 1 < walk.steps.size(); ++step) {
    const auto report =
        tree.extend(walk.steps[step].action, walk.steps[step].view, [] { return true; });
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->revived, 0);
    EXPECT_GT(report->leaves, 0);
    waited += report->deferred;
  }
  EXPECT_GT(waited, 0);
  EXPECT_FALSE(tree.guarantee_given_up());
  const auto last = tree.extend(walk.steps.back().action, walk.steps.back().view);
  ASSERT_TRUE(last.ok());
  EXPECT_GT(last->revived, 0);
  // As if there had always been time: Fig. 4 of Savelli and Kuipers, IROS 2004.
  EXPECT_EQ(tree.live_count(), 62);
  EXPECT_EQ(tree.waiting_count(), 0);
  EXPECT_EQ(count_true_maps(tree, walk), 1);
}

TEST(Budget, TheRootFollowsWhatAllAgreeOn) {
  Traveller robot(corner(), 0);
  EXPECT_EQ(robot.tree().settled_through(), VisitId{0});
  robot.travel(0, tee(), 2);
  EXPECT_EQ(robot.travel(1, dead_end(), 0).settled_through, VisitId{2});  // Nothing to close.
  robot.travel(0, tee(), 0);
  EXPECT_EQ(robot.tree().live_count(), 1);
  EXPECT_EQ(robot.tree().settled_through(), VisitId{3});
  const ExtendReport closing = robot.travel(1, corner(), 1);
  ASSERT_EQ(robot.tree().live_count(), 2);  // Is it the first corner?
  EXPECT_LT(closing.settled_through, VisitId{4});
  EXPECT_GE(closing.settled_through, VisitId{2});
}

TEST(Budget, TheGapIsInfiniteWhenNothingWaitsAndProvesTheBestWhenPositive) {
  Traveller alone(corner(), 0);
  alone.travel(0, corner(), 1);
  EXPECT_EQ(alone.tree().proven_gap(), std::numeric_limits<double>::infinity());
  // With evidence there is always more to hope for, unless it tells its bound.
  Evidence bounded = laps(4, 4.0);
  bounded.same_place_bound = [](VisitId visit) { return visit.value < 4 ? -4.0 : 4.0; };
  Traveller robot = around_the_block(at_most(2), bounded);
  Traveller vague = around_the_block(at_most(2), laps(4, 4.0));
  for (int visit = 5; visit < 20; ++visit) {
    robot.travel(1, corner(), 1);
    vague.travel(1, corner(), 1);
  }
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_GT(robot.tree().waiting_count(), 0);
  EXPECT_GT(robot.tree().proven_gap(), 0.0);
  EXPECT_TRUE(std::isfinite(robot.tree().proven_gap()));
  EXPECT_LT(vague.tree().proven_gap(), robot.tree().proven_gap());
}

}  // namespace
}  // namespace cairn::test
