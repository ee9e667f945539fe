// A robot that finds itself somewhere: switched on in a known map, or carried.

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "traveller.hpp"

namespace cairn::test {
namespace {

TopologyOptions mode(bool is_noisy, double claim_odds = 100.0) {
  TopologyOptions options;
  options.noisy_stars = is_noisy;
  options.claim_odds = claim_odds;
  return options;
}

/// A corner between two dead ends: one closed map.
Traveller in_an_alley(const TopologyOptions& options = {}, Evidence evidence = {}) {
  Traveller robot(dead_end(), 0, options, std::move(evidence));
  robot.travel(0, corner(), 0);
  robot.travel(1, dead_end(), 0);
  return robot;
}

/// Says of visits by the places where they truly were.
Evidence truth(std::vector<int> place_of_visit, double log_ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway known, SeenGateway now) {
    return place_of_visit.at(known.visit.index()) == place_of_visit.at(now.visit.index())
               ? log_ratio
               : -log_ratio;
  };
  return evidence;
}

TEST(WakeUp, MayBeAtEveryGatewayThatLooksSoAndElsewhere) {
  Traveller alley = in_an_alley();
  const ExtendReport report = alley.wake_up(dead_end(), 0);
  EXPECT_EQ(report.count(StepKind::kRelocated), 2);
  EXPECT_EQ(report.count(StepKind::kElsewhere), 1);
  EXPECT_EQ(alley.tree().live_count(), 3);
  EXPECT_EQ(report.count(Refutation::kOtherView), 2);  // The gateways of the corner.

  Traveller square(crossing(), 0);
  const ExtendReport anywhere = square.wake_up(crossing(), 0);
  EXPECT_EQ(anywhere.count(StepKind::kRelocated), 4);
  EXPECT_EQ(anywhere.count(StepKind::kElsewhere), 1);
}

TEST(WakeUp, ClaimsNoPlaceUntilTheOddsSuffice) {
  Traveller robot = in_an_alley();
  robot.wake_up(dead_end(), 0);
  EXPECT_FALSE(robot.tree().claimed_place());
  robot.travel(0, corner(), 0);  // By the first end, or by an alley never seen before.
  EXPECT_EQ(robot.tree().live_count(), 2);
  EXPECT_FALSE(robot.tree().claimed_place());  // e^2 to 1.

  Traveller bold = in_an_alley(mode(false, 7.0));
  bold.wake_up(dead_end(), 0);
  EXPECT_FALSE(bold.tree().claimed_place());
  bold.travel(0, corner(), 0);
  const auto claim = bold.tree().claimed_place();
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->first_visit, VisitId{1});
  EXPECT_NEAR(claim->log_odds, 2.0, 1e-12);
}

TEST(WakeUp, RecognisedPlacesAreClaimedInTheStrictAndInTheNoisyWorld) {
  for (const bool is_noisy : {false, true}) {
    SCOPED_TRACE(is_noisy);
    const Evidence evidence = truth({0, 1, 2, 2, 1, 0}, 2.0);
    Traveller robot = in_an_alley(mode(is_noisy), evidence);
    robot.wake_up(dead_end(), 0);
    // Two nats for the second end, two against the first, one against elsewhere: e^3 to 1 at most.
    EXPECT_FALSE(robot.tree().claimed_place());
    robot.travel(0, corner(), 1);
    robot.travel(1, dead_end(), 0);
    const auto claim = robot.tree().claimed_place();
    ASSERT_TRUE(claim);
    EXPECT_EQ(claim->first_visit, VisitId{0});
    EXPECT_GE(claim->log_odds, std::log(100.0));
    EXPECT_EQ(robot.best_map().place_count(), 3);
    EXPECT_TRUE(robot.best_map().is_carried(VisitId{3}));
    EXPECT_FALSE(robot.best_map().is_carried(VisitId{4}));
  }
}

TEST(WakeUp, AtAStarThatNoPlaceHasIsElsewhereAndJoinedWhenALoopCloses) {
  for (const bool is_noisy : {false, true}) {
    for (const bool is_planar : {false, true}) {
      SCOPED_TRACE(testing::Message() << is_noisy << is_planar);
      TopologyOptions options = mode(is_noisy);
      options.planar = is_planar;
      Traveller robot(dead_end(), 0, options, truth({0, 1, 2, 1, 0}, 5.0));
      robot.travel(0, tee(), 0);     // The stem is still to be seen.
      robot.wake_up(crossing(), 0);  // Never seen; the stem leads there.
      EXPECT_EQ(robot.best().place_count, 3);
      EXPECT_EQ(robot.best_map().component_count(), 2);
      robot.travel(1, tee(), 1);
      EXPECT_EQ(robot.best().place_count, 3);
      EXPECT_EQ(robot.best_map().component_count(), 1);
      EXPECT_EQ(robot.tree().step(robot.best().id), StepKind::kClosure);
      EXPECT_EQ(robot.best_map().linked_to({PlaceId{2}, 1}), (GatewayRef{PlaceId{1}, 1}));
      robot.travel(2, dead_end(), 0);  // Out by the arm through which it first came.
      EXPECT_EQ(robot.best().place_count, 3);
      EXPECT_EQ(robot.best().contradictions, 0);
    }
  }
}

TEST(WakeUp, WhereNothingFitsAtAllTheNewPlaceIsFound) {
  TopologyOptions options = mode(false);
  options.max_places = 1;
  Traveller robot(dead_end(), 0, options);
  const ExtendReport report = robot.wake_up(crossing(), 0);
  EXPECT_GT(report.leaves, 0);
  EXPECT_EQ(robot.best().place_count, 2);
}

TEST(WakeUp, InANoisyWorldTheStarMayBeMisreadMeanwhile) {
  Traveller robot = in_an_alley(mode(true), truth({0, 1, 2, 1, 2}, 10.0));
  robot.wake_up(corridor(), 0);  // The corner, seen as if straight; one of its two gateways.
  robot.travel(1, dead_end(), 0);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best_map().at_visit(VisitId{3}).place, PlaceId{1});
  EXPECT_EQ(robot.best_map().at_visit(VisitId{4}).place, PlaceId{2});
}

TEST(WakeUp, ManyTimesLeavesSoundMaps) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Traveller robot = in_an_alley(mode(seed % 2 == 0));
    std::mt19937 random(seed);
    for (int visit = 3; visit < 20; ++visit) {
      const ExtendReport report =
          random() % 3 == 0 ? robot.wake_up(corner(), 1) : robot.travel(0, corner(), visit % 2);
      ASSERT_GT(report.leaves, 0);
      for (const TopologicalMap& map : robot.maps()) {
        ASSERT_EQ(map.visit_count(), visit + 1);
      }
    }
  }
}

}  // namespace
}  // namespace cairn::test
