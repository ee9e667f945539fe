// Why a map is what it is, and why others are not.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using Considered = HypothesisTree::Considered;

auto sentence(const char* text) {
  return Field(&Considered::sentence, HasSubstr(text));
}

/// Position of the alternative that leads there.
std::size_t position_of(const std::vector<Considered>& all, StepKind kind, GatewayRef target) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Considered& one) {
    return one.kind == kind && one.target == target;
  });
  EXPECT_NE(found, all.end());
  return static_cast<std::size_t>(found - all.begin());
}

constexpr GatewayRef kNowhere{};

/// The live hypothesis whose map has so many places.
HypothesisId with_places(const Traveller& robot, int places) {
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    if (leaf.place_count == places) {
      return leaf.id;
    }
  }
  ADD_FAILURE() << "none with " << places << " places";
  return {};
}

TEST(Explanation, OfAnAcceptedClosureTellsWhatItWasAndWhatElseItMightHaveBeen) {
  const Traveller robot = around_the_block();
  const auto all = robot.tree().explanation(with_places(robot, 4), VisitId{4});
  EXPECT_THAT(all, Contains(AllOf(Field(&Considered::is_taken, true),
                                  sentence("closure to gateway 1 of place 0: possible"),
                                  sentence("[taken]"))));
  EXPECT_THAT(all, Contains(AllOf(Field(&Considered::is_taken, false), sentence("new place"))));
  EXPECT_THAT(all, Not(Contains(AllOf(sentence("new place"), sentence("[taken]")))));
}

TEST(Explanation, OfARefutedClosureTellsTheReason) {
  // A view that differs, and the axiom.
  Traveller street(crossing(), 0);
  street.travel(0, crossing(), 0);
  const auto axiom = street.tree().explanation(street.best().id, VisitId{1});
  EXPECT_THAT(axiom, Contains(sentence("refuted: a place would be twice on a path (axiom)")));
  Traveller corners(corner(), 0);
  corners.travel(0, corner(), 1);
  corners.travel(1, corner(), 0);
  EXPECT_THAT(corners.tree().explanation(corners.best().id, VisitId{2}),
              Contains(AllOf(Field(&Considered::kind, StepKind::kClosure),
                             sentence("refuted: the star looks different from there"))));
  TopologyOptions options;
  options.max_places = 1;
  Traveller bounded(crossing(), 0, options);
  bounded.travel(1, tee(), 0);
  EXPECT_THAT(bounded.tree().explanation(bounded.best().id, VisitId{1}),
              Contains(sentence("more than max_places places")));
}

TEST(Explanation, HasExactlyOneTakenAlternativeAtEveryVisitOfEveryMap) {
  const Traveller robot = around_the_block();
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    for (VisitId visit{0}; visit.value < 5; ++visit.value) {
      const auto all = robot.tree().explanation(leaf.id, visit);
      EXPECT_EQ(
          std::count_if(all.begin(), all.end(), [](const Considered& one) { return one.is_taken; }),
          1);
    }
  }
}

TEST(Explanation, TellsWhereTwoMapsPartAndWhatDecides) {
  const Traveller robot = around_the_block({}, laps(4, 3.0));
  const HypothesisId square = with_places(robot, 4);
  const HypothesisId triangle = with_places(robot, 3);
  const HypothesisTree::Parting parting = robot.tree().parting(square, triangle);
  EXPECT_EQ(parting.visit, VisitId{3});
  EXPECT_EQ(parting.of_a.kind, StepKind::kNewPlace);
  EXPECT_EQ(parting.of_b.kind, StepKind::kClosure);
  EXPECT_EQ(parting.of_b.target, (GatewayRef{PlaceId{0}, 1}));
  // -1 for a new place and 3 for the recognised one, against twice -3.
  EXPECT_DOUBLE_EQ(parting.log_odds, (-1.0 + 3.0) - (-3.0 - 3.0));
  EXPECT_THAT(parting.sentence,
              AllOf(HasSubstr("part at visit 3"), HasSubstr("new place"), HasSubstr("closure")));
  EXPECT_DOUBLE_EQ(robot.tree().parting(triangle, square).log_odds, -parting.log_odds);
}

TEST(WhyNot, ARefutedAlternativeIsRefutedThere) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, corner(), 0);
  const auto all = robot.tree().explanation(robot.best().id, VisitId{2});
  const auto fate = robot.tree().why_not(robot.best().id, VisitId{2},
                                         position_of(all, StepKind::kClosure, {PlaceId{0}, 1}));
  EXPECT_TRUE(fate.is_refuted);
  EXPECT_EQ(fate.visit, VisitId{2});
  EXPECT_EQ(fate.reason, Refutation::kOtherView);
}

TEST(WhyNot, AClosureMayBeRefutedOnlyLater) {
  Traveller robot = around_the_block();
  robot.travel(1, corner(), 0);  // A left turn: none of the loops.
  ASSERT_EQ(robot.tree().live_count(), 1);
  const HypothesisId chain = robot.best().id;
  for (int closing = 2; closing <= 4; ++closing) {
    const VisitId visit{closing};
    const auto all = robot.tree().explanation(chain, visit);
    const auto fate =
        robot.tree().why_not(chain, visit, position_of(all, StepKind::kClosure, {PlaceId{0}, 1}));
    EXPECT_TRUE(fate.is_refuted);
    EXPECT_EQ(fate.visit, VisitId{5});
    EXPECT_EQ(fate.reason, Refutation::kOtherView);
    EXPECT_THAT(fate.sentence, HasSubstr("refuted later, at visit 5"));
  }
}

TEST(WhyNot, ARivalThatExplainsEverythingIsJudgedByItsOdds) {
  const Traveller robot = around_the_block({}, laps(4, 3.0));
  const HypothesisId square = with_places(robot, 4);
  const auto all = robot.tree().explanation(square, VisitId{3});
  const auto fate = robot.tree().why_not(square, VisitId{3},
                                         position_of(all, StepKind::kClosure, {PlaceId{0}, 1}));
  EXPECT_FALSE(fate.is_refuted);
  EXPECT_DOUBLE_EQ(fate.log_odds, robot.tree().parting(with_places(robot, 3), square).log_odds);
  const auto taken =
      robot.tree().why_not(square, VisitId{3}, position_of(all, StepKind::kNewPlace, kNowhere));
  EXPECT_FALSE(taken.is_refuted);
  EXPECT_THAT(taken.sentence, HasSubstr("what the hypothesis took"));
}

// The likeliest next step may be a blind alley.
TEST(WhyNot, AMapIsRefutedOnlyIfNoWayOnIsLeft) {
  Traveller robot = around_the_block();
  robot.travel(1, corner(), 0);  // Six corners in a chain.
  for (int visit = 6; visit < 11; ++visit) {
    robot.travel(1, corner(), 1);
  }
  robot.travel(1, corner(), 0);  // The same left turn, if the loop closed at visit 6.
  const HypothesisId loop = with_places(robot, 6);
  const auto all = robot.tree().explanation(loop, VisitId{6});
  ASSERT_TRUE(all[position_of(all, StepKind::kClosure, {PlaceId{0}, 1})].is_taken);
  const auto fate =
      robot.tree().why_not(loop, VisitId{6}, position_of(all, StepKind::kNewPlace, kNowhere));
  EXPECT_FALSE(fate.is_refuted) << fate.sentence;
  EXPECT_DOUBLE_EQ(fate.log_odds, -6.0);
}

TEST(WhyNot, IsNotFoundOutWithinTooFewSteps) {
  TopologyOptions options;
  options.max_repair_steps = 1;
  Traveller robot = around_the_block(options);
  const auto fate = robot.tree().why_not(with_places(robot, 4), VisitId{2}, 0);
  EXPECT_FALSE(fate.is_refuted);
  EXPECT_THAT(fate.sentence, HasSubstr("not found out in 1 steps"));
}

}  // namespace
}  // namespace cairn::test
