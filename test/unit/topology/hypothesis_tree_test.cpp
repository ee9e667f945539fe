#include "topology/hypothesis_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "support/stars.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(HypothesisTree, BeginsWithOnePlace) {
  const Traveller robot(tee(), 1);
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.tree().node_count(), 1);
  EXPECT_FALSE(robot.tree().parent(robot.best().id).is_valid());
  EXPECT_THAT(robot.tree().explanation(robot.best().id, VisitId{0}),
              ElementsAre(HasSubstr("first place")));
}

TEST(HypothesisTree, AroundABlockItHoldsEveryLoopAndTheChain) {
  const Traveller robot = around_the_block();
  EXPECT_EQ(robot.tree().node_count(), 11);
  EXPECT_EQ(robot.tree().maps_built(), 8);
  EXPECT_THAT(robot.tree().fringe(), SizeIs(4));
}

TEST(HypothesisTree, TheSimplestHasFewestPathsThenPlaces) {
  TopologyOptions options;
  options.preference = Preference::kSimplest;
  const Traveller robot = around_the_block(options);
  std::vector<int> paths;
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    paths.push_back(leaf.map.path_count());
  }
  EXPECT_THAT(paths, ElementsAre(2, 3, 4, 6));
}

TEST(HypothesisTree, ReportsWhatAnArrivalDid) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, corner(), 1);
  const ExtendReport report = robot.travel(1, corner(), 1);
  EXPECT_EQ(report.visit, VisitId{3});
  EXPECT_EQ(report.leaves, report.nodes_added);
  EXPECT_EQ(report.nodes_added, report.closures + report.new_places + report.known_links);
  EXPECT_EQ(report.known_links, 1);
  EXPECT_EQ(report.closures, 1);
  EXPECT_FALSE(report.guarantee_given_up);
  EXPECT_FALSE(report.was_break_needed);
}

TEST(HypothesisTree, AKnownLinkThatDisagreesEndsAHypothesis) {
  Traveller robot = around_the_block();
  // On with a left turn: the loops expected a right turn.
  const ExtendReport report = robot.travel(1, corner(), 0);
  EXPECT_EQ(report.links_contradicted, 3);
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.best().map.place_count(), 6);
}

TEST(HypothesisTree, RebuildsTheMapOfEveryVisit) {
  const Traveller robot = around_the_block();
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    for (VisitId visit{0}; visit.value < 5; ++visit.value) {
      const TopologicalMap rebuilt = robot.tree().map_at(leaf.id, visit);
      EXPECT_EQ(rebuilt.visit_count(), visit.value + 1);
      EXPECT_EQ(rebuilt.at_visit(visit), leaf.map.at_visit(visit));
    }
    const TopologicalMap rebuilt = robot.tree().map_at(leaf.id, VisitId{4});
    EXPECT_EQ(rebuilt.position(), leaf.map.position());
    EXPECT_EQ(rebuilt.pending_gateways(), leaf.map.pending_gateways());
  }
}

TEST(HypothesisTree, AHypothesisKeepsItsNameWhileItsMapDoes) {
  Traveller robot(corner(), 0);
  robot.travel(0, tee(), 2);
  const HypothesisId grown = robot.best().id;
  robot.travel(0, corner(), 0);
  EXPECT_EQ(robot.best().id, grown);
  robot.travel(1, corner(), 0);
  EXPECT_EQ(robot.best().parent, grown);
  EXPECT_EQ(robot.tree().parent(robot.best().id), grown);
  EXPECT_EQ(robot.tree().visit(robot.best().id), VisitId{3});
  EXPECT_EQ(robot.tree().step(robot.best().id).kind, StepKind::kNewPlace);
}

TEST(HypothesisTree, ExplainsWhatWasTakenAndWhatWasRefuted) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, tee(), 2);
  robot.travel(1, corner(), 1);
  const std::vector<std::string> lines = robot.tree().explanation(robot.best().id, VisitId{3});
  EXPECT_THAT(lines, Contains(HasSubstr("[taken]")));
  EXPECT_THAT(lines, Contains(HasSubstr("refuted: the star looks different from there")));
  EXPECT_THAT(lines, Each(HasSubstr("visit 3 (L), after leaving by gateway 0 of place 2")));
}

TEST(HypothesisTree, EvidenceDecidesBetweenClosures) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap& before, VisitId visit, PlaceId same_as, int) {
    return before.first_visit(same_as).value % 4 == visit.value % 4 ? 6.0 : -6.0;
  };
  const Traveller robot = around_the_block(options, evidence);
  EXPECT_EQ(robot.best().map.place_count(), 4);
  EXPECT_TRUE(robot.best().map.is_closed());
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), 6.0 + 3.0 * options.log_prior_new_place);
  const std::vector<double> shares = robot.tree().probabilities();
  EXPECT_GT(shares.front(), 0.95);
  EXPECT_THAT(std::accumulate(shares.begin(), shares.end(), 0.0), DoubleNear(1.0, 1e-12));
}

TEST(HypothesisTree, EvidenceCountsOnKnownLinksToo) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) { return -3.0; };
  Traveller robot(corner(), 0, options, evidence);
  robot.travel(0, tee(), 2);
  robot.travel(0, corner(), 0);
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), options.log_prior_new_place - 3.0);
}

TEST(HypothesisTree, LayoutIsEvaluatedOnceForEachLeafNearTheBest) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  options.layout_margin = 5.0;
  int evaluated = 0;
  Evidence evidence;
  // Fits only if no loop of less than four places is closed.
  evidence.layout = [&](const TopologicalMap& map) {
    ++evaluated;
    return map.closure_count() > 0 && map.place_count() < 4 ? -40.0 : 0.0;
  };
  Traveller robot(corner(), 0, options, evidence);
  robot.travel(0, corner(), 1);
  std::int64_t reported = 2;
  std::int64_t leaves = 2;
  for (int side = 1; side < 4; ++side) {
    const ExtendReport report = robot.travel(1, corner(), 1);
    EXPECT_EQ(report.layouts_evaluated + report.layouts_deferred, report.leaves);
    reported += report.layouts_evaluated;
    leaves += report.leaves;
  }
  EXPECT_EQ(evaluated, reported);
  EXPECT_LT(reported, leaves);
  EXPECT_EQ(robot.best().map.place_count(), 4);
  EXPECT_FALSE(robot.best().is_layout_deferred);
  EXPECT_TRUE(robot.tree().fringe().back().is_layout_deferred);
  EXPECT_LT(robot.tree().fringe().back().log_posterior(), -39.0);  // The parent's, as a bound.
}

TEST(HypothesisTree, TheBudgetKeepsTheBestAndSaysWhatItDropped) {
  TopologyOptions options;
  options.max_hypotheses = 2;
  const Traveller robot = around_the_block(options);
  EXPECT_THAT(robot.tree().fringe(), SizeIs(2));
  ASSERT_TRUE(robot.tree().guarantee_given_up());
  EXPECT_EQ(robot.tree().guarantee_given_up()->visit, VisitId{3});
  EXPECT_EQ(robot.tree().guarantee_given_up()->loss, GuaranteeLoss::kBudget);
  EXPECT_EQ(robot.tree().guarantee_given_up()->reason, "3 hypotheses, max_hypotheses is 2");
}

TEST(HypothesisTree, TheBudgetReportsTheBestItDropped) {
  TopologyOptions options;
  options.max_hypotheses = 1;
  options.preference = Preference::kPosterior;
  Traveller robot(corner(), 0, options);
  robot.travel(0, corner(), 1);
  const ExtendReport report = robot.travel(1, corner(), 1);
  EXPECT_EQ(report.dropped, 1);
  EXPECT_DOUBLE_EQ(report.best_dropped_log_posterior, 2.0 * options.log_prior_new_place);
  EXPECT_EQ(robot.best().map.place_count(), 2);
}

TEST(HypothesisTree, SameExperienceGivesTheSameTree) {
  const Lattice streets(3, 3);
  const Walk walk = streets.walk(0, "EESWWSEENNWSSW");
  std::vector<HypothesisTree> trees(2, HypothesisTree(TopologyOptions{}));
  for (HypothesisTree& tree : trees) {
    tree.start(walk.start);
    for (const Experienced& step : walk.steps) {
      tree.extend(step.action, step.view);
    }
  }
  ASSERT_EQ(trees[0].fringe().size(), trees[1].fringe().size());
  for (std::size_t leaf = 0; leaf < trees[0].fringe().size(); ++leaf) {
    EXPECT_EQ(trees[0].fringe()[leaf].id, trees[1].fringe()[leaf].id);
    EXPECT_EQ(trees[0].fringe()[leaf].map.position(), trees[1].fringe()[leaf].map.position());
  }
}

TEST(HypothesisTree, ForgetsWhatDiedOutButNoAncestorOfALeaf) {
  const Lattice streets(5, 5);
  std::mt19937 random(1);
  const Walk walk = streets.walk(0, streets.random_moves(0, 90, random));
  TopologyOptions options;
  options.planar = false;
  options.max_hypotheses = 200;
  Traveller robot(walk.start.star, walk.start.arrival_gateway, options);
  for (const Experienced& step : walk.steps) {
    robot.travel(step.action.turn, step.view.star, step.view.arrival_gateway);
  }
  std::int32_t newest = 0;
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    newest = std::max(newest, leaf.id.value);
    for (HypothesisId at = leaf.id; at.is_valid(); at = robot.tree().parent(at)) {
      ASSERT_TRUE(robot.tree().is_known(at));
    }
  }
  std::int32_t known = 0;
  for (HypothesisId id{0}; id.value <= newest; ++id.value) {
    known += robot.tree().is_known(id) ? 1 : 0;
  }
  EXPECT_LT(known, newest / 2);
}

TEST(HypothesisTree, AMapHandedOutKeepsWhatItKnowsWhileTheTreeGoesOn) {
  Traveller robot(corner(), 0);
  const TopologicalMap handed_out = robot.best().map;
  robot.travel(0, tee(), 2);
  EXPECT_EQ(handed_out.place_count(), 1);
  EXPECT_EQ(handed_out.star(PlaceId{0}), corner());
}

TEST(TopologyOptions, NamesEveryFieldOutOfRange) {
  TopologyOptions options;
  EXPECT_TRUE(validate(options).ok());
  options.max_places = 0;
  options.max_hypotheses = 0;
  options.log_prior_new_place = std::nan("");
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("topology.max_places"));
  EXPECT_THAT(status.error().message, HasSubstr("topology.max_hypotheses"));
  EXPECT_THAT(status.error().message, HasSubstr("topology.log_prior_new_place"));
}

TEST(HypothesisTreeDeathTest, RefusesExperienceThatBreaksItsPreconditions) {
  Traveller robot(corner(), 0);
  EXPECT_DEATH(robot.travel(2, corner(), 0), "turn");
  EXPECT_DEATH(robot.travel(0, corner(), 2), "validate");
  EXPECT_DEATH(robot.travel(0, Star{}, 0), "validate");
  HypothesisTree fresh{TopologyOptions{}};
  EXPECT_DEATH(fresh.extend({0}, {corner(), 0, VisitId{0}}), "is_started");
  EXPECT_DEATH(fresh.start({corner(), 0, VisitId{5}}), "visit");
}

}  // namespace
}  // namespace cairn::test
