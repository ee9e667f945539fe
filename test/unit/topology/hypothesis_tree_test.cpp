#include "topology/hypothesis_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

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
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(HypothesisTree, BeginsWithOnePlace) {
  const Traveller robot(tee(), 1);
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.tree().node_count(), 1);
  EXPECT_FALSE(robot.tree().parent(robot.best().id).is_valid());
  EXPECT_THAT(robot.tree().explanation(robot.best().id, VisitId{0}),
              ElementsAre(Field(&HypothesisTree::Considered::sentence, HasSubstr("first place"))));
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
    EXPECT_EQ(leaf.path_count, robot.tree().map(leaf.id).path_count());
    paths.push_back(leaf.path_count);
  }
  EXPECT_THAT(paths, ElementsAre(2, 3, 4, 6));
}

TEST(HypothesisTree, ReportsWhatAnArrivalDid) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, corner(), 1);
  const ExtendReport report = robot.travel(1, corner(), 1);
  EXPECT_EQ(report.visit, VisitId{3});
  EXPECT_EQ(report.leaves, report.nodes_added());
  EXPECT_EQ(report.nodes_added(), report.count(StepKind::kClosure) +
                                      report.count(StepKind::kNewPlace) +
                                      report.count(StepKind::kKnownLink));
  EXPECT_EQ(report.count(StepKind::kKnownLink), 1);
  EXPECT_EQ(report.count(StepKind::kClosure), 1);
  EXPECT_EQ(report.waiting, 0);
  EXPECT_FALSE(report.guarantee_given_up);
  EXPECT_FALSE(report.repair);
}

TEST(HypothesisTree, AKnownLinkThatDisagreesEndsAHypothesis) {
  Traveller robot = around_the_block();
  // On with a left turn: the loops expected a right turn.
  const ExtendReport report = robot.travel(1, corner(), 0);
  EXPECT_EQ(report.links_contradicted, 3);
  ASSERT_THAT(robot.tree().fringe(), SizeIs(1));
  EXPECT_EQ(robot.best().place_count, 6);
  EXPECT_EQ(robot.best_map().place_count(), 6);
}

TEST(HypothesisTree, RebuildsTheMapOfEveryVisit) {
  const Traveller robot = around_the_block();
  for (const Hypothesis& leaf : robot.tree().fringe()) {
    const TopologicalMap map = robot.tree().map(leaf.id);
    for (VisitId visit{0}; visit.value < 5; ++visit.value) {
      const TopologicalMap rebuilt = robot.tree().map_at(leaf.id, visit);
      EXPECT_EQ(rebuilt.visit_count(), visit.value + 1);
      EXPECT_EQ(rebuilt.at_visit(visit), map.at_visit(visit));
    }
    const TopologicalMap rebuilt = robot.tree().map_at(leaf.id, VisitId{4});
    EXPECT_EQ(rebuilt.position(), map.position());
    EXPECT_EQ(rebuilt.pending_gateways(), map.pending_gateways());
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
  EXPECT_EQ(robot.tree().step(robot.best().id), StepKind::kNewPlace);
}

TEST(HypothesisTree, ExplainsWhatWasTakenAndWhatWasRefuted) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  robot.travel(1, tee(), 2);
  robot.travel(1, corner(), 1);
  std::vector<std::string> lines;
  for (const HypothesisTree::Considered& one :
       robot.tree().explanation(robot.best().id, VisitId{3})) {
    lines.push_back(one.sentence);
  }
  EXPECT_THAT(lines, Contains(HasSubstr("[taken]")));
  EXPECT_THAT(lines, Contains(HasSubstr("refuted: the star looks different from there")));
  EXPECT_THAT(lines, Each(HasSubstr("visit 3 (L), after leaving by gateway 0 of place 2")));
}

TEST(HypothesisTree, EvidenceDecidesBetweenClosures) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  const Traveller robot = around_the_block(options, laps(4, 6.0));
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_TRUE(robot.best_map().is_closed());
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), 6.0 + 3.0 * options.log_prior_new_place);
  const std::vector<double> shares = robot.tree().probabilities();
  EXPECT_GT(shares.front(), 0.95);
  EXPECT_THAT(std::accumulate(shares.begin(), shares.end(), 0.0), DoubleNear(1.0, 1e-12));
}

TEST(HypothesisTree, EvidenceCountsOnKnownLinksToo) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  Traveller robot(corner(), 0, options, always(-3.0));
  robot.travel(0, tee(), 2);
  robot.travel(0, corner(), 0);
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), options.log_prior_new_place - 3.0);
}

TEST(HypothesisTree, LayoutIsEvaluatedOnceForEachLeafNearTheBest) {
  TopologyOptions options;
  options.preference = Preference::kPosterior;
  options.layout_margin = 5.0;
  options.live_margin = 100.0;
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
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_FALSE(robot.best().is_layout_deferred);
  EXPECT_TRUE(robot.tree().fringe().back().is_layout_deferred);
  EXPECT_LT(robot.tree().fringe().back().log_posterior(), -39.0);  // The parent's, as a bound.
}

TEST(HypothesisTree, BeyondTheBudgetTheOthersWait) {
  TopologyOptions options;
  options.max_hypotheses = 2;
  const Traveller robot = around_the_block(options);
  EXPECT_THAT(robot.tree().fringe(), SizeIs(2));
  EXPECT_EQ(robot.tree().live_count(), 2);
  // One is not looked at since the third corner, and stands for two maps: square and chain.
  EXPECT_EQ(robot.tree().waiting_count(), 1);
  EXPECT_FALSE(robot.tree().guarantee_given_up());
}

TEST(HypothesisTree, TheBudgetReportsHowManyBeganToWaitAndTheGapToThem) {
  TopologyOptions options;
  options.max_hypotheses = 1;
  Traveller robot(corner(), 0, options);
  robot.travel(0, corner(), 1);
  const ExtendReport report = robot.travel(1, corner(), 1);
  EXPECT_EQ(report.dropped, 0);
  EXPECT_EQ(report.deferred, 1);
  EXPECT_EQ(report.waiting, 1);
  EXPECT_EQ(report.leaves, 1);
  EXPECT_EQ(robot.best().place_count, 2);
  // The new place waits in its parent, which knows how likely it is.
  EXPECT_DOUBLE_EQ(robot.tree().proven_gap(), -options.log_prior_new_place);
}

TEST(HypothesisTree, SameExperienceGivesTheSameTree) {
  const Lattice streets(3, 3);
  const Walk walk = streets.walk(0, "EESWWSEENNWSSW");
  std::vector<HypothesisTree> trees;
  trees.emplace_back(TopologyOptions{});
  trees.emplace_back(TopologyOptions{});
  for (HypothesisTree& tree : trees) {
    ASSERT_TRUE(tree.start(walk.start).ok());
    for (const Experienced& step : walk.steps) {
      ASSERT_TRUE(tree.extend(step.action, step.view).ok());
    }
  }
  const std::vector<Hypothesis> fringe = trees[0].fringe();
  const std::vector<Hypothesis> again = trees[1].fringe();
  ASSERT_EQ(fringe.size(), again.size());
  for (std::size_t leaf = 0; leaf < fringe.size(); ++leaf) {
    EXPECT_EQ(fringe[leaf].id, again[leaf].id);
    EXPECT_EQ(trees[0].map(fringe[leaf].id).position(), trees[1].map(again[leaf].id).position());
  }
}

TEST(HypothesisTree, ForgetsWhatDiedOutButNoAncestorOfALeaf) {
  const Walk walk = Lattice(4, 4).walk(0, snake_moves(4, 4));
  TopologyOptions options;
  options.max_places = 16;
  options.max_hypotheses = 100'000;
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
  const std::vector<HypothesisTree::NodeView> nodes = robot.tree().nodes();
  std::set<HypothesisId> parents;
  for (const HypothesisTree::NodeView& node : nodes) {
    parents.insert(node.parent);
  }
  for (const HypothesisTree::NodeView& node : nodes) {
    EXPECT_TRUE(node.is_live || parents.count(node.id) > 0) << "nobody needs " << node.id.value;
  }
  EXPECT_LT(nodes.size(), static_cast<std::size_t>(newest) / 2);
}

TEST(HypothesisTree, AMapHandedOutKeepsWhatItKnowsWhileTheTreeGoesOn) {
  Traveller robot(corner(), 0);
  const TopologicalMap handed_out = robot.best_map();
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

}  // namespace
}  // namespace cairn::test
