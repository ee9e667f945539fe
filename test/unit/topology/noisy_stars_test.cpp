// A world in which perception errs: every way to blame an observation arises where it is right.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::Contains;
using ::testing::Field;
using Considered = HypothesisTree::Considered;

TopologyOptions noisy() {
  TopologyOptions options;
  options.noisy_stars = true;
  return options;
}

/// Two visits are to the same place if these numbers are the same.
Evidence truth(std::vector<int> place_of_visit, double log_ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway known, SeenGateway now) {
    return place_of_visit.at(known.visit.index()) == place_of_visit.at(now.visit.index())
               ? log_ratio
               : -log_ratio;
  };
  return evidence;
}

/// What the best hypothesis took a visit for.
Considered taken(const Traveller& robot, int visit) {
  for (const Considered& one : robot.tree().explanation(robot.best().id, VisitId{visit})) {
    if (one.is_taken) {
      return one;
    }
  }
  ADD_FAILURE();
  return {};
}

std::vector<int> places(const TopologicalMap& map) {
  std::vector<int> places;
  for (VisitId visit{0}; visit.value < map.visit_count(); ++visit.value) {
    places.push_back(map.at_visit(visit).place.value);
  }
  return places;
}

/// A corner between two dead ends; then what the robot sees on its way back at the corner.
Traveller back_at_the_corner(const Star& seen, int arrival_gateway) {
  Traveller robot(dead_end(), 0, noisy());
  robot.travel(0, corner(), 0);
  robot.travel(1, dead_end(), 0);
  robot.travel(0, seen, arrival_gateway);
  return robot;
}

TEST(NoisyStars, AStarMisreadOnceIsBlamedWhenLaterVisitsAgreeWithTheFirst) {
  Traveller robot = back_at_the_corner(corridor(), 1);
  robot.travel(1, dead_end(), 0);
  robot.travel(0, corner(), 0);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(taken(robot, 3).kind, StepKind::kMisread);
  EXPECT_EQ(taken(robot, 3).misreading, Misreading::kFragments);
  EXPECT_EQ(robot.best_map().star(PlaceId{1}), corner());
}

TEST(NoisyStars, AStarIsCorrectedWhenLaterVisitsAgreeAgainstTheFirst) {
  Traveller robot(dead_end(), 0, noisy());
  robot.travel(0, corridor(), 0);  // In truth a corner.
  robot.travel(1, dead_end(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, dead_end(), 0);
  robot.travel(0, corner(), 0);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(taken(robot, 3).kind, StepKind::kAmended);
  const TopologicalMap map = robot.best_map();
  EXPECT_EQ(gateway_count(map.star(PlaceId{1})), 2);
  EXPECT_FALSE(map.through({PlaceId{1}, 0})) << "it is a corner now";
  EXPECT_EQ(places(map), (std::vector<int>{0, 1, 2, 1, 0, 1}));
}

TEST(NoisyStars, APlaceIsPassedWithoutNotice) {
  Traveller robot(dead_end(), 0, noisy());
  robot.travel(0, corridor(), 0);
  robot.travel(1, dead_end(), 0);
  robot.travel(0, dead_end(), 0);  // Back at the first end, without having seen the middle.
  robot.travel(0, corridor(), 0);
  robot.travel(1, dead_end(), 0);
  EXPECT_EQ(taken(robot, 3).kind, StepKind::kUnnoticed);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(places(robot.best_map()), (std::vector<int>{0, 1, 2, 0, 1, 2}));
  EXPECT_TRUE(robot.best_map().is_closed());
}

TEST(NoisyStars, APlaceIsNoticedLateAndPutIntoItsLink) {
  Traveller robot(dead_end(), 0, noisy(), truth({0, 1, 2, 0, 2, 1}, 5.0));
  robot.travel(0, dead_end(), 0);
  robot.travel(0, tee(), 2);  // On the way back there is a place in between, with a stem.
  robot.travel(1, dead_end(), 0);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(taken(robot, 2).kind, StepKind::kInserted);
  robot.travel(0, tee(), 0);
  robot.travel(2, dead_end(), 0);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(places(robot.best_map()), (std::vector<int>{0, 1, 2, 0, 2, 1}));
  EXPECT_EQ(robot.best_map().pending_count(), 1);  // The stem.
}

TEST(NoisyStars, TheRobotLeavesByAGatewayThatTheFirstVisitMissed) {
  Traveller robot = back_at_the_corner(tee(), 2);  // A third gateway: straight on.
  ASSERT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 2);
  robot.travel(1, dead_end(), 0);
  EXPECT_EQ(robot.best().place_count, 4);
  const TopologicalMap map = robot.best_map();
  EXPECT_EQ(gateway_count(map.star(PlaceId{1})), 3);
  EXPECT_TRUE(map.is_closed());
  robot.travel(0, tee(), 0);
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_EQ(robot.best_map().position().place, PlaceId{1});
  EXPECT_EQ(places(robot.best_map()), (std::vector<int>{0, 1, 2, 1, 3, 1}));
}

/// What a matcher says who knows the gateways of a lattice by their directions; visits may have
/// numbered them otherwise than the walk.
Evidence gateways_of(const Walk& walk, const Lattice& streets, int missed_visit, int missed) {
  Evidence evidence;
  const auto direction = [=](SeenGateway seen) {
    int number = seen.gateway;
    if (seen.visit.value == missed_visit && number >= missed) {
      ++number;
    }
    for (int facing = 0; facing < 4; ++facing) {
      const int place = walk.truth[seen.visit.index()].first;
      if (streets.is_open(place, facing) && streets.gateway_of(place, facing) == number) {
        return facing;
      }
    }
    return -1;
  };
  evidence.same_place = [=](SeenGateway known, SeenGateway now) {
    return walk.truth[known.visit.index()].first == walk.truth[now.visit.index()].first &&
                   direction(known) == direction(now)
               ? 12.0
               : -12.0;
  };
  return evidence;
}

TEST(NoisyStars, TheRobotArrivesByAGatewayThatTheFirstVisitMissed) {
  const Lattice streets(2, 3);
  const Walk walk = streets.walk(0, "EESWNWE");
  const int stem = streets.gateway_of(1, 2);
  Traveller robot(walk.start.star, walk.start.arrival_gateway, noisy(),
                  gateways_of(walk, streets, 1, stem));
  for (const Experienced& step : walk.steps) {
    View view = step.view;
    Action action = step.action;
    if (view.visit == VisitId{1}) {
      view.star = corridor();  // East and west; the stem south is missed.
      view.arrival_gateway = 1;
    }
    if (view.visit == VisitId{2}) {
      action.turn = 1;  // Straight on; the walk counts the stem.
    }
    robot.travel(action.turn, view);
  }
  EXPECT_EQ(taken(robot, 5).kind, StepKind::kAmended);
  EXPECT_EQ(taken(robot, 5).misreading, Misreading::kMissedGateway);
  EXPECT_EQ(robot.best().place_count, 5);
  EXPECT_EQ(places(robot.best_map()), (std::vector<int>{0, 1, 2, 3, 4, 1, 0, 1}));
  EXPECT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 3);
  EXPECT_EQ(robot.best().contradictions, 1);
}

TEST(NoisyStars, AFalseGatewayIsDroppedWhenTheOthersDoNotSeeIt) {
  Traveller robot(dead_end(), 0, noisy());
  robot.travel(0, tee(), 0);  // Its third gateway is none: the place is a corner.
  robot.travel(1, dead_end(), 0);
  for (int lap = 0; lap < 2; ++lap) {
    robot.travel(0, corner(), 1);
    robot.travel(1, dead_end(), 0);
    robot.travel(0, corner(), 0);
    robot.travel(1, dead_end(), 0);
  }
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 2);
  EXPECT_TRUE(robot.best_map().is_closed());
}

TEST(NoisyStars, TheGatewayByWhichTheRobotStoodAtFirstIsKept) {
  Traveller robot(tee(), 2, noisy());
  robot.travel(1, dead_end(), 0);  // By the other arm; ...
  for (int lap = 0; lap < 3; ++lap) {
    robot.travel(0, corner(), 0);  // ... now the gateway where it began is not seen.
    robot.travel(0, dead_end(), 0);
  }
  robot.tree().for_each_map([](const Hypothesis&, const TopologicalMap& map) {
    EXPECT_LT(map.gateway_at(VisitId{0}, 2), map.gateway_count(map.at_visit(VisitId{0}).place));
  });
}

/// The first visit to a place was perceived as a corner, or, less likely, as a tee.
View corner_or_tee() {
  View view{corner(), 1, VisitId{1}};
  view.log_likelihood = -0.1;
  view.others = {{tee(), {-1, 0, 1}, -2.0}};
  return view;
}

TEST(NoisyStars, TheSecondReadingMayTurnOutRightInTheStrictWorldToo) {
  for (const bool is_noisy : {false, true}) {
    SCOPED_TRACE(is_noisy);
    TopologyOptions options;
    options.noisy_stars = is_noisy;
    Traveller robot(dead_end(), 0, options);
    const ExtendReport both = robot.travel(0, corner_or_tee());
    EXPECT_EQ(both.count(StepKind::kNewPlace), 2);
    EXPECT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 2);
    EXPECT_DOUBLE_EQ(robot.best().log_posterior(), options.log_prior_new_place - 0.1);
    robot.travel(0, dead_end(), 0);
    robot.travel(0, tee(), 2);
    EXPECT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 3);
    EXPECT_EQ(robot.best().contradictions, 0);
    EXPECT_DOUBLE_EQ(robot.best().log_posterior(), options.log_prior_new_place - 2.0);
    EXPECT_EQ(robot.best_map().pending_count(), 2);
  }
}

TEST(NoisyStars, TheFirstReadingStaysWhereLaterVisitsAgreeWithIt) {
  Traveller robot(dead_end(), 0);
  robot.travel(0, corner_or_tee());
  robot.travel(0, dead_end(), 0);
  robot.travel(0, corner(), 1);
  EXPECT_EQ(robot.tree().live_count(), 1);
  EXPECT_EQ(gateway_count(robot.best_map().star(PlaceId{1})), 2);
  EXPECT_EQ(robot.best().contradictions, 0);
}

TEST(NoisyStars, WhatNothingExplainsIsABreakAndRejoinedLater) {
  const Star four_stubs = star_of({0, 1, 2, 3, -1, -1, -1, -1}, {4, 5, 6, 7, 0, 1, 2, 3});
  Traveller robot(corner(), 0, noisy(), truth({0, 1, 2, 1, 2}, 6.0));
  robot.travel(0, tee(), 2);
  EXPECT_EQ(robot.travel(0, four_stubs, 0).count(StepKind::kContradiction), 1);
  robot.travel(0, tee(), 2);
  EXPECT_GT(robot.travel(0, four_stubs, 0).count(StepKind::kRejoin), 0);
  EXPECT_EQ(taken(robot, 2).kind, StepKind::kContradiction);
  EXPECT_EQ(taken(robot, 4).kind, StepKind::kRejoin);
  EXPECT_EQ(places(robot.best_map()), (std::vector<int>{0, 1, 2, 1, 2}));
  EXPECT_EQ(robot.best_map().component_count(), 2);
}

}  // namespace
}  // namespace cairn::test
