// A strict world in which a star is misread all the same: every map dies, and observations must be
// blamed.

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "traveller.hpp"
#include "true_map.hpp"

namespace cairn::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// The same gateways, but no fragment passes through.
Star with_ends(const Star& star) {
  const auto gateways = static_cast<std::size_t>(gateway_count(star));
  Star seen;
  for (std::size_t slot = 0; slot < 2 * gateways; ++slot) {
    const bool leaves = slot < gateways;
    seen.slots.push_back({leaves ? static_cast<int>(slot) : -1, (slot + gateways) % (2 * gateways),
                          leaves ? ControlLaw::kMidline : ControlLaw::kDeadEnd});
  }
  return seen;
}

TEST(Repair, BlamesTheVisitThatMisreadTheStarAndGoesOnWithTheTrueMap) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  robot.travel(1, dead_end(), 0);
  robot.travel(0, tee(), 0);
  robot.travel(1, dead_end(), 0);  // A street of two blind alleys...
  robot.travel(0, tee(), 1);
  const ExtendReport report = robot.travel(1, corridor(), 0);  // ... and the first corner again.
  ASSERT_TRUE(report.repair);
  EXPECT_TRUE(report.repair->is_explained);
  ASSERT_THAT(report.repair->blamed, SizeIs(1));
  EXPECT_EQ(report.repair->blamed[0].visit, VisitId{6});
  EXPECT_EQ(report.repair->blamed[0].misreading, Misreading::kFragments);
  EXPECT_LT(report.repair->blamed[0].log_likelihood, 0.0);
  EXPECT_GT(report.repair->steps, 0);
  ASSERT_TRUE(report.guarantee_given_up);
  EXPECT_EQ(report.guarantee_given_up->loss, GuaranteeLoss::kContradiction);
  EXPECT_THAT(report.guarantee_given_up->reason, HasSubstr("visit 6"));
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_EQ(robot.best_map().position(), (GatewayRef{PlaceId{0}, 0}));
  // The next corner view is none: the corner is as it was known to be.
  EXPECT_FALSE(robot.travel(0, tee(), 2).repair);
}

// A misreading that leaves some map standing is no contradiction; all others are repaired.
TEST(Repair, OnALatticeTheVisitIsBlamedAndTheTrueMapGoesOn) {
  int true_maps = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const Lattice streets(3, 3);
    const Walk walk = streets.walk(0, streets.random_moves(0, 80, random));
    TopologyOptions options;
    options.max_places = 9;
    Traveller robot(walk.start.star, walk.start.arrival_gateway, options);
    for (const Experienced& step : walk.steps) {
      View view = step.view;
      if (view.visit == VisitId{40}) {
        view.star = with_ends(view.star);
      }
      const ExtendReport report = robot.travel(step.action.turn, view);
      ASSERT_GT(report.leaves, 0);
      EXPECT_FALSE(report.repair && view.visit < VisitId{40});
      EXPECT_FALSE(report.repair && !report.repair->is_explained);
    }
    true_maps += count_true_maps(robot.tree(), walk) > 0 ? 1 : 0;
  }
  EXPECT_GE(true_maps, 18);
}

TEST(Repair, AStarThatWasMisreadTheFirstTimeIsCorrected) {
  Traveller robot(dead_end(), 0);
  robot.travel(0, star_of({0, 1, -1, -1}, {3, 2, 1, 0}), 0);  // In truth a corner.
  robot.travel(1, dead_end(), 0);
  const ExtendReport once = robot.travel(0, corner(), 1);
  ASSERT_TRUE(once.repair);
  EXPECT_TRUE(once.repair->is_explained);
  robot.travel(1, dead_end(), 0);
  const ExtendReport twice = robot.travel(0, corner(), 0);
  // One misreading explains all: the first.
  const TopologicalMap map = robot.best_map();
  EXPECT_EQ(map.place_count(), 3);
  EXPECT_EQ(robot.best().contradictions, twice.repair ? 2 : 1);
}

TEST(Repair, NeverLeavesAnEmptyTreeWhateverTheStars) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::vector<Star> stars = {dead_end(), corridor(), corner(), tee(), crossing()};
    TopologyOptions options;
    options.max_hypotheses = 20;
    options.max_repair_steps = 300;
    Traveller robot(crossing(), 0, options);
    int gateways = 4;
    for (int visit = 1; visit < 40; ++visit) {
      const Star& star = stars[random() % stars.size()];
      const int turn = static_cast<int>(random() % static_cast<unsigned>(gateways));
      gateways = gateway_count(star);
      const ExtendReport report =
          robot.travel(turn, star, static_cast<int>(random() % static_cast<unsigned>(gateways)));
      ASSERT_GT(report.leaves, 0);
      EXPECT_LE(robot.tree().settled_through(), report.visit);
      for (const Hypothesis& leaf : robot.tree().fringe()) {
        const TopologicalMap map = robot.tree().map(leaf.id);
        ASSERT_EQ(map.place_count(), leaf.place_count);
        ASSERT_EQ(map.path_count(), leaf.path_count);
        ASSERT_EQ(map.visit_count(), visit + 1);
      }
    }
  }
}

// What all agreed on before may be in doubt after the past was searched.
TEST(Repair, WhatIsSettledIsWhatAllLiveMapsShare) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Lattice streets(3, 3);
    const Walk walk = streets.walk(0, streets.random_moves(0, 30, random));
    Traveller robot(walk.start.star, walk.start.arrival_gateway);
    for (const Experienced& step : walk.steps) {
      View view = step.view;
      if (random() % 10 == 0) {
        view.star = with_ends(view.star);
      }
      robot.travel(step.action.turn, view);
      const VisitId settled = robot.tree().settled_through();
      const auto first = robot.tree().map_at(robot.best().id, settled);
      for (const Hypothesis& leaf : robot.tree().fringe()) {
        const TopologicalMap map = robot.tree().map_at(leaf.id, settled);
        for (VisitId visit{0}; visit <= settled; ++visit.value) {
          ASSERT_EQ(map.at_visit(visit).place, first.at_visit(visit).place);
        }
      }
    }
  }
}

}  // namespace
}  // namespace cairn::test
