// What an operator says about visits.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr VisitId visit(int number) {
  return {number};
}

/// The places of all visits, the posterior and the number of live hypotheses: all but the ids.
auto state_of(const HypothesisTree& tree) {
  std::vector<std::vector<int>> places;
  std::vector<double> posteriors;
  tree.for_each_map([&](const Hypothesis& leaf, const TopologicalMap& map) {
    posteriors.push_back(leaf.log_posterior());
    places.emplace_back();
    for (VisitId at{0}; at.value < map.visit_count(); ++at.value) {
      places.back().push_back(map.at_visit(at).place.value);
    }
  });
  return std::pair(posteriors, places);
}

TEST(Assertions, DifferentTakesTheMapsAwayThatSayOtherwise) {
  Traveller robot = around_the_block();
  ASSERT_EQ(robot.best().place_count, 2);
  const auto report = robot.tree().assert_places(visit(0), visit(2), false, "Ada");
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->assertion, 1);
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(report->best, robot.best().id);
  EXPECT_DOUBLE_EQ(report->log_posterior_before, -1.0);
  EXPECT_DOUBLE_EQ(report->log_posterior_after, -2.0);
  ASSERT_THAT(report->moved, Contains(Field(&MovedVisit::visit, visit(2))));
  EXPECT_EQ(report->moved[0].place_before, visit(0));
  EXPECT_EQ(report->moved[0].place_after, visit(2));
  EXPECT_THAT(report->sentence, HasSubstr("visit 2"));
  for (const TopologicalMap& map : robot.maps()) {
    EXPECT_NE(map.at_visit(visit(0)).place, map.at_visit(visit(2)).place);
  }
  EXPECT_FALSE(robot.tree().guarantee_given_up());
}

TEST(Assertions, SameKeepsTheMapsOnlyThatSaySo) {
  Traveller robot = around_the_block();
  ASSERT_TRUE(robot.tree().assert_places(visit(4), visit(0), true, "Ada").ok());
  EXPECT_EQ(robot.tree().live_count(), 2);  // The square, and two corners met twice.
  ASSERT_TRUE(robot.tree().assert_places(visit(2), visit(0), false, "Ada").ok());
  EXPECT_EQ(robot.tree().live_count(), 1);
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_TRUE(robot.best_map().is_closed());
}

TEST(Assertions, HoldForWhatComesLaterToo) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(1), false, "Ada").ok());
  for (int side = 1; side < 4; ++side) {
    robot.travel(1, corner(), 1);
  }
  EXPECT_EQ(robot.tree().live_count(), 4);
  EXPECT_EQ(state_of(robot.tree()), state_of(around_the_block().tree()));
}

TEST(Assertions, TakenBackRestoreTheFormerHypothesesExactly) {
  Traveller robot = around_the_block();
  const auto before = state_of(robot.tree());
  const auto different = robot.tree().assert_places(visit(0), visit(2), false, "Ada");
  const auto same = robot.tree().assert_places(visit(0), visit(4), true, "Bob");
  ASSERT_TRUE(different.ok() && same.ok());
  EXPECT_NE(state_of(robot.tree()), before);
  ASSERT_TRUE(robot.tree().retract(different->assertion, "Eve").ok());
  const auto report = robot.tree().retract(same->assertion, "Eve");
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(state_of(robot.tree()), before);
  EXPECT_DOUBLE_EQ(report->log_posterior_after, -1.0);
  robot.travel(1, corner(), 1);
  Traveller never_told = around_the_block();
  never_told.travel(1, corner(), 1);
  EXPECT_EQ(state_of(robot.tree()), state_of(never_told.tree()));
}

TEST(Assertions, AreAllKeptForTheAudit) {
  Traveller robot = around_the_block();
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(2), false, "Ada").ok());
  robot.travel(1, corner(), 1);
  ASSERT_TRUE(robot.tree().retract(1, "Bob").ok());
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(4), true, "Eve").ok());
  const std::vector<OperatorAssertion>& all = robot.tree().assertions();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].who, "Ada");
  EXPECT_EQ(all[0].made_after_visits, 5);
  EXPECT_EQ(all[0].retracted_after_visits, 6);
  EXPECT_EQ(all[0].retracted_by, "Bob");
  EXPECT_EQ(all[1].number, 2);
  EXPECT_FALSE(all[1].retracted_after_visits);
}

TEST(Assertions, ThatContradictOthersAreErrorsAndChangeNothing) {
  Traveller robot = around_the_block();
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(2), true, "Ada").ok());
  ASSERT_TRUE(robot.tree().assert_places(visit(2), visit(4), true, "Ada").ok());
  ASSERT_TRUE(robot.tree().assert_places(visit(1), visit(4), false, "Ada").ok());
  const auto before = state_of(robot.tree());
  const HypothesisId best = robot.best().id;
  const auto not_same = robot.tree().assert_places(visit(0), visit(4), false, "Bob");
  ASSERT_FALSE(not_same.ok());
  EXPECT_EQ(not_same.error().code, ErrorCode::kContradiction);
  const auto same = robot.tree().assert_places(visit(0), visit(1), true, "Bob");
  ASSERT_FALSE(same.ok());
  EXPECT_THAT(same.error().message, HasSubstr("it contradicts assertion 3"));
  EXPECT_EQ(state_of(robot.tree()), before);
  EXPECT_EQ(robot.best().id, best);
  EXPECT_THAT(robot.tree().assertions(), SizeIs(3));
}

TEST(Assertions, OfUnknownVisitsOrNumbersAreErrors) {
  Traveller robot = around_the_block();
  const auto beyond = robot.tree().assert_places(visit(0), visit(5), true, "Ada");
  ASSERT_FALSE(beyond.ok());
  EXPECT_EQ(beyond.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(beyond.error().message, HasSubstr("expected one in [0, 5), got 5"));
  EXPECT_FALSE(robot.tree().assert_places(VisitId{}, visit(1), true, "Ada").ok());
  EXPECT_FALSE(robot.tree().assert_places(visit(1), visit(1), true, "Ada").ok());
  EXPECT_FALSE(robot.tree().retract(1, "Ada").ok());
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(2), true, "Ada").ok());
  ASSERT_TRUE(robot.tree().retract(1, "Ada").ok());
  EXPECT_THAT(robot.tree().retract(1, "Ada").error().message, HasSubstr("already been taken back"));
  HypothesisTree fresh{TopologyOptions{}};
  EXPECT_FALSE(fresh.assert_places(visit(0), visit(1), true, "Ada").ok());
}

TEST(Assertions, TwoAboutOneVisitMustBothHold) {
  Traveller robot = around_the_block();
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(4), true, "Ada").ok());
  ASSERT_TRUE(robot.tree().assert_places(visit(2), visit(4), true, "Ada").ok());
  ASSERT_EQ(robot.tree().live_count(), 1);
  EXPECT_EQ(robot.best().place_count, 2);
  EXPECT_EQ(robot.best().contradictions, 0);
}

TEST(Assertions, ThatNothingElseSupportsAreObeyedAllTheSame) {
  for (const bool is_noisy : {false, true}) {
    TopologyOptions options;
    options.noisy_stars = is_noisy;
    Traveller robot(dead_end(), 0, options);
    robot.travel(0, crossing(), 0);
    robot.travel(1, crossing(), 0);
    robot.travel(1, dead_end(), 0);
    ASSERT_TRUE(robot.tree().assert_places(visit(1), visit(2), true, "Ada").ok());
    const TopologicalMap map = robot.best_map();
    EXPECT_EQ(map.at_visit(visit(1)).place, map.at_visit(visit(2)).place);
    EXPECT_GT(robot.best().contradictions, 0);
  }
}

TEST(Assertions, AreNamedWhereTheyDecide) {
  Traveller robot = around_the_block();
  ASSERT_TRUE(robot.tree().assert_places(visit(0), visit(2), false, "Ada").ok());
  EXPECT_THAT(robot.tree().explanation(robot.best().id, visit(2)),
              Contains(Field(&HypothesisTree::Considered::sentence,
                             HasSubstr("refuted: an operator says otherwise"))));
}

TEST(Assertions, ChainsHoldBetweenAllTheirVisits) {
  for (const auto& [first, second] : {std::pair(0, 2), std::pair(2, 3)}) {
    Traveller robot(crossing(), 0);
    for (int visit = 1; visit < 9; ++visit) {
      robot.travel(1, crossing(), 0);
    }
    HypothesisTree& tree = robot.tree();
    ASSERT_TRUE(tree.assert_places(VisitId{first}, VisitId{6}, true, "me").ok());
    ASSERT_TRUE(tree.assert_places(VisitId{second}, VisitId{6}, true, "me").ok());
    tree.for_each_map(
        [&, first = first, second = second](const Hypothesis&, const TopologicalMap& map) {
          EXPECT_EQ(map.at_visit(VisitId{first}).place, map.at_visit(VisitId{6}).place);
          EXPECT_EQ(map.at_visit(VisitId{second}).place, map.at_visit(VisitId{6}).place);
        });
  }
}

}  // namespace
}  // namespace cairn::test
