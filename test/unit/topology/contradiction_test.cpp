// A tree whose hypotheses the world contradicts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"
#include "topology/hypothesis_tree.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(Contradiction, NeverEndsEmptyWhenTheWorldContradictsEveryMap) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  const ExtendReport report = robot.travel(0, dead_end(), 0);  // The corner was expected.
  EXPECT_TRUE(report.was_break_needed);
  EXPECT_EQ(report.links_contradicted, 1);
  ASSERT_TRUE(report.guarantee_given_up);
  EXPECT_EQ(report.guarantee_given_up->visit, VisitId{2});
  EXPECT_EQ(report.guarantee_given_up->loss, GuaranteeLoss::kContradiction);
  EXPECT_THAT(report.guarantee_given_up->reason,
              HasSubstr("visit 2 (D), after leaving by gateway 2 of place 1: known link to gateway "
                        "0 of place 0 (L): refuted: the star looks different from there"));
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.best().map.place_count(), 3);
  EXPECT_TRUE(robot.best().map.is_unexplained({PlaceId{2}, 0}));
  EXPECT_THAT(robot.tree().explanation(robot.best().id, VisitId{2}),
              Contains(HasSubstr("break [taken]")));
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), 2.0 * TopologyOptions{}.log_prior_new_place -
                                                     TopologyOptions{}.log_penalty_break);
}

TEST(Contradiction, GoesOnAfterAContradiction) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  robot.travel(0, dead_end(), 0);
  const ExtendReport back = robot.travel(0, tee(), 2);  // By the unexplained gateway.
  EXPECT_FALSE(back.was_break_needed);
  EXPECT_EQ(robot.best().map.position(), (GatewayRef{PlaceId{1}, 2}));
  const ExtendReport again = robot.travel(0, dead_end(), 0);
  EXPECT_EQ(again.rejoins, 1);
  EXPECT_FALSE(again.was_break_needed);
  EXPECT_EQ(robot.best().map.place_count(), 3);
}

TEST(Contradiction, WithEvidenceAContradictedHypothesisLivesOnAndMayBeProvenRight) {
  // On its third lap the robot takes a corner for a tee. That it was on its way all the same shows
  // when the next corners are recognised.
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap& before, VisitId visit, PlaceId same_as, int) {
    return before.first_visit(same_as).value % 4 == visit.value % 4 ? 8.0 : -8.0;
  };
  Traveller robot = around_the_block({}, evidence);
  for (int visit = 5; visit < 9; ++visit) {
    robot.travel(1, corner(), 1);
  }
  const ExtendReport misread = robot.travel(1, tee(), 2);
  EXPECT_GT(misread.breaks, 0);
  robot.travel(1, corner(), 1);
  robot.travel(1, corner(), 1);
  const Hypothesis& best = robot.best();
  EXPECT_EQ(best.contradictions, 2);
  EXPECT_EQ(best.map.place_count(), 5);  // The block and the misread corner.
  EXPECT_EQ(best.map.at_visit(VisitId{11}).place, best.map.at_visit(VisitId{3}).place);
}

TEST(Contradiction, OnlyTheBestSurviveAContradiction) {
  TopologyOptions options;
  options.max_broken_hypotheses = 2;
  Traveller robot = around_the_block(options);
  robot.travel(0, corner(), 0);  // Back the way it came: known to every hypothesis.
  const ExtendReport report = robot.travel(0, tee(), 0);
  EXPECT_TRUE(report.was_break_needed);
  EXPECT_EQ(report.leaves, 2);
  EXPECT_EQ(report.dropped, 2);
}

TEST(Contradiction, ABoundOnPlacesIsOverruledRatherThanEndingEmpty) {
  TopologyOptions options;
  options.max_places = 1;
  Traveller robot(corner(), 0, options);
  const ExtendReport report = robot.travel(0, tee(), 0);
  EXPECT_EQ(report.beyond_place_bound, 1);
  EXPECT_TRUE(report.was_break_needed);
  EXPECT_EQ(robot.best().map.place_count(), 2);
  EXPECT_FALSE(robot.best().map.is_pending({PlaceId{0}, 0}));
}

TEST(Contradiction, ContradictedHypothesesStayWithinTheBoundOnPlaces) {
  TopologyOptions options;
  options.max_places = 4;
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) { return 1.0; };
  Traveller robot = around_the_block(options, evidence);
  const ExtendReport report = robot.travel(1, tee(), 2);
  EXPECT_EQ(report.breaks, 2);  // Of the loops of two and three corners.
  EXPECT_EQ(report.links_contradicted, 3);
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    EXPECT_LE(leaf.map.place_count(), 4);
  }
}

}  // namespace
}  // namespace cairn::test
