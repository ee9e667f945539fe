// Evidence of several visits to a place, and what it makes of maps that have a part twice.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "arrivals.hpp"
#include "support/stars.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

TEST(IndependentAnswers, AreWorthLessTheMoreTheyDependOnEachOther) {
  EXPECT_DOUBLE_EQ(independent_answers(1, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(independent_answers(4, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(independent_answers(4, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(independent_answers(4, 0.5), 1.6);
}

/// To and fro between a corner and a tee: the next visit is the fourth to the corner.
void go_to_and_fro(Arrivals& walk) {
  walk.add_place(0, tee(), 2).follow(0, corner(), 0);
  walk.follow(0, tee(), 2).follow(0, corner(), 0).follow(0, tee(), 2);
}

TEST(SeveralVisits, AreAskedTheLatestFirst) {
  std::vector<int> asked;
  Evidence evidence;
  evidence.same_place = [&](SeenGateway known, SeenGateway) {
    asked.push_back(known.visit.value);
    return 0.0;
  };
  TopologyOptions options;
  options.max_visits_compared = 2;
  Arrivals walk(corner(), 0, options, evidence);
  go_to_and_fro(walk);
  walk.of(0, corner(), 0);
  EXPECT_THAT(asked, ElementsAre(4, 2));
}

TEST(SeveralVisits, CountAsFarAsTheyAreIndependent) {
  Evidence evidence;
  evidence.same_place = [](SeenGateway, SeenGateway) { return 3.0; };
  for (const auto& [correlation, expected] : {std::pair(0.0, 9.0), std::pair(1.0, 3.0)}) {
    TopologyOptions options;
    options.evidence_correlation = correlation;
    Arrivals walk(corner(), 0, options, evidence);
    go_to_and_fro(walk);
    EXPECT_DOUBLE_EQ(walk.of(0, corner(), 0)[0].log_likelihood, expected);
  }
}

TEST(SeveralVisits, OneThatSaysItIsImpossibleRefutes) {
  Evidence evidence;
  evidence.same_place = [](SeenGateway known, SeenGateway) {
    return known.visit.value == 2 ? -std::numeric_limits<double>::infinity() : 15.0;
  };
  Arrivals walk(corner(), 0, {}, evidence);
  go_to_and_fro(walk);
  EXPECT_EQ(walk.of(0, corner(), 0)[0].refuted_by, Refutation::kEvidence);
}

/// Visits are to one place exactly if four divides what lies between them.
Evidence of_the_block(double ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway known, SeenGateway now) {
    return (now.visit.value - known.visit.value) % 4 == 0 ? ratio : -ratio;
  };
  return evidence;
}

TEST(SeveralVisits, SpeakAgainstAPartThatIsThereTwice) {
  TopologyOptions options;
  options.evidence_correlation = 0.0;
  Traveller robot = around_the_block(options, of_the_block(1.0));
  for (int visit = 5; visit < 20; ++visit) {
    robot.travel(1, corner(), 1);
  }
  // Around the block twice as eight places: every visit is one more than there should be.
  double of_twice = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& one : robot.tree().fringe()) {
    of_twice = one.place_count == 8 ? std::max(of_twice, one.log_posterior()) : of_twice;
  }
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_GT(robot.best().log_posterior(), of_twice + 12.0);
}

TEST(Waiting, SuccessorsWaitInTheirParentAndEachOfThemCounts) {
  TopologyOptions options;
  options.max_hypotheses = 1;
  options.max_revivals = 0;
  Traveller robot(crossing(), 0, options);
  robot.travel(1, tee(), 2);
  const ExtendReport report = robot.travel(1, crossing(), 0);
  EXPECT_EQ(report.leaves, 1);
  EXPECT_EQ(report.leaves + report.deferred, report.nodes_added());
  EXPECT_EQ(report.waiting, robot.tree().waiting_count());
}

// The fourth corner of the block is not recognised when the robot comes back to it, later ones are:
// a map that is there twice never contradicts that, it only misses what evidence says.
TEST(Waiting, AHypothesisFarBelowTheBestComesBackWhenEvidenceNamesWhatTheBestOneMisses) {
  Evidence evidence;
  evidence.same_place = [](SeenGateway known, SeenGateway now) {
    const bool is_same = (now.visit.value - known.visit.value) % 4 == 0;
    return is_same && now.visit.value == 4 ? -5.0 : is_same ? 8.0 : -8.0;
  };
  TopologyOptions options;
  options.live_margin = 3.0;
  Traveller robot = around_the_block(options, evidence);
  EXPECT_EQ(robot.best().place_count, 5);
  EXPECT_EQ(robot.tree().live_count(), 1);
  EXPECT_GT(robot.tree().waiting_count(), 0);
  std::int64_t revived = 0;
  for (int visit = 5; visit < 8; ++visit) {
    revived += robot.travel(1, corner(), 1).revived;
  }
  EXPECT_GT(revived, 0);
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_FALSE(robot.tree().guarantee_given_up());
}

TEST(Waiting, WhatIsNotLookedAtForWantOfTimeWaitsOnce) {
  // A surprise at the last visit makes the tree look at everyone again.
  Evidence evidence;
  evidence.same_place = [](SeenGateway known, SeenGateway now) {
    return known.visit.value == 1 && now.visit.value == 4 ? 20.0 : -1.0;
  };
  TopologyOptions options;
  options.noisy_stars = true;
  options.log_penalty_break = 1.0;
  HypothesisTree tree(options, evidence);
  ASSERT_TRUE(tree.start({corner(), 0, VisitId{0}}).ok());
  ASSERT_TRUE(tree.extend({0}, {corner(), 1, VisitId{1}}).ok());
  ASSERT_TRUE(tree.extend({1}, {corner(), 1, VisitId{2}}).ok());
  ASSERT_TRUE(tree.extend({1}, {corner(), 1, VisitId{3}}).ok());
  const std::int64_t live = tree.live_count();
  const std::int64_t waiting = tree.waiting_count();
  ASSERT_GT(live, 1);
  const auto report = tree.extend({1}, {corner(), 1, VisitId{4}}, [] { return true; });
  ASSERT_TRUE(report);
  // One is looked at; its successors live or wait.
  EXPECT_EQ(report->leaves + report->waiting, report->nodes_added() + live - 1 + waiting);
}

}  // namespace
}  // namespace cairn::test
