// A tree whose hypotheses the world contradicts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"
#include "topology/hypothesis_tree.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Four gateways, none in line with another: no misreading makes a corner of it, and it lies on no
/// corridor.
Star four_stubs() {
  return star_of({0, 1, 2, 3, -1, -1, -1, -1}, {4, 5, 6, 7, 0, 1, 2, 3});
}

TopologyOptions noisy() {
  TopologyOptions options;
  options.noisy_stars = true;
  return options;
}

TEST(Contradiction, NeverEndsEmptyWhenTheWorldContradictsEveryMap) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  const ExtendReport report = robot.travel(0, four_stubs(), 0);  // The corner was expected.
  ASSERT_TRUE(report.repair);
  EXPECT_FALSE(report.repair->is_explained);
  EXPECT_THAT(report.repair->blamed, ElementsAre(Field(&Blame::visit, VisitId{2})));
  EXPECT_GT(report.links_contradicted, 0);
  EXPECT_EQ(report.breaks, 1);
  ASSERT_TRUE(report.guarantee_given_up);
  EXPECT_EQ(report.guarantee_given_up->visit, VisitId{2});
  EXPECT_EQ(report.guarantee_given_up->loss, GuaranteeLoss::kContradiction);
  EXPECT_THAT(report.guarantee_given_up->reason, HasSubstr("blamed: visit 2: break"));
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.best().place_count, 3);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_TRUE(robot.best_map().is_unexplained({PlaceId{2}, 0}));
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), 2.0 * TopologyOptions{}.log_prior_new_place -
                                                     TopologyOptions{}.log_penalty_break);
}

TEST(Contradiction, IsExplainedByWhatTheKnownLinkPromised) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  robot.travel(0, four_stubs(), 0);
  const auto lines = robot.tree().explanation(robot.best().id, VisitId{2});
  const auto sentence = [](const char* text) {
    return Contains(Field(&HypothesisTree::Considered::sentence, HasSubstr(text)));
  };
  EXPECT_THAT(lines, sentence("after leaving by gateway 2 of place 1: known link to gateway 0 of "
                              "place 0: refuted: the star looks different from there"));
  EXPECT_THAT(lines, sentence("break: nothing else explains it"));
}

TEST(Contradiction, GoesOnAfterAContradiction) {
  for (const TopologyOptions& options : {TopologyOptions{}, noisy()}) {
    SCOPED_TRACE(options.noisy_stars);
    Traveller robot(corner(), 0, options);
    robot.travel(0, tee(), 2);
    robot.travel(0, four_stubs(), 0);
    const ExtendReport back = robot.travel(0, tee(), 2);  // By the unexplained gateway.
    EXPECT_FALSE(back.repair);
    EXPECT_EQ(robot.best_map().position(), (GatewayRef{PlaceId{1}, 2}));
    const ExtendReport again = robot.travel(0, four_stubs(), 0);
    EXPECT_GT(again.count(StepKind::kRejoin), 0);
    EXPECT_FALSE(again.repair);
    EXPECT_EQ(robot.best().place_count, 3);
    EXPECT_EQ(robot.best_map().position(), (GatewayRef{PlaceId{2}, 0}));
  }
}

TEST(Contradiction, WithEvidenceAContradictedHypothesisLivesOnAndMayBeProvenRight) {
  // On its third lap the robot takes a corner for a tee. That it was on its way all the same shows
  // when the next corners are recognised.
  Traveller robot = around_the_block(noisy(), laps(4, 8.0));
  for (int visit = 5; visit < 9; ++visit) {
    robot.travel(1, corner(), 1);
  }
  const ExtendReport misread = robot.travel(1, tee(), 2);
  EXPECT_GT(misread.count(StepKind::kMisread), 0);
  robot.travel(2, corner(), 1);  // By the gateway beside the imagined one.
  robot.travel(1, corner(), 1);
  EXPECT_EQ(robot.best().contradictions, 1);
  EXPECT_EQ(robot.best().place_count, 4);  // The block alone.
  const TopologicalMap map = robot.best_map();
  EXPECT_EQ(map.at_visit(VisitId{9}).place, map.at_visit(VisitId{1}).place);
  EXPECT_EQ(map.at_visit(VisitId{11}).place, map.at_visit(VisitId{3}).place);
}

TEST(Contradiction, OnlyTheBestSurviveAContradiction) {
  TopologyOptions options;
  options.max_broken_hypotheses = 2;
  Traveller robot = around_the_block(options);
  robot.travel(0, corner(), 0);  // Back the way it came: known to every hypothesis.
  ASSERT_EQ(robot.tree().live_count(), 4);
  const ExtendReport report = robot.travel(0, four_stubs(), 0);
  ASSERT_TRUE(report.repair);
  EXPECT_FALSE(report.repair->is_explained);
  EXPECT_EQ(report.leaves, 2);
  EXPECT_EQ(report.dropped, 2);
}

TEST(Contradiction, ABoundOnPlacesIsOverruledRatherThanEndingEmpty) {
  TopologyOptions options;
  options.max_places = 1;
  Traveller robot(corner(), 0, options);
  const ExtendReport report = robot.travel(0, tee(), 0);
  EXPECT_GT(report.count(Refutation::kTooManyPlaces), 0);
  ASSERT_TRUE(report.repair);
  EXPECT_FALSE(report.repair->is_explained);
  EXPECT_EQ(robot.best().place_count, 2);
  EXPECT_FALSE(robot.best_map().is_pending({PlaceId{0}, 0}));
}

TEST(Contradiction, HypothesesThatBlameAnObservationStayWithinTheBoundOnPlaces) {
  TopologyOptions options = noisy();
  options.max_places = 4;
  Traveller robot = around_the_block(options, always(1.0));
  const ExtendReport report = robot.travel(1, tee(), 2);
  EXPECT_GT(report.links_contradicted, 0);
  EXPECT_FALSE(report.repair);
  for (const TopologicalMap& map : robot.maps()) {
    EXPECT_LE(map.place_count(), 4);
  }
}

}  // namespace
}  // namespace cairn::test
