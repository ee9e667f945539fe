#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "bench/lab/recognition_building.hpp"
#include "bench/lab/recognition_fit.hpp"
#include "bench/lab/recognition_pairs.hpp"

namespace cairn::lab {
namespace {

using ::testing::SizeIs;

TEST(Building, CanBeWalkedThroughInEverySession) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Building building(seed);
    for (const int session : {0, 1, 2}) {
      SCOPED_TRACE(testing::Message() << seed << " in session " << session);
      const sim::World world = building.session(session, 20);
      const std::vector<sim::NamedPoint>& way = world.tours.front().waypoints;
      ASSERT_THAT(way, SizeIs(21));
      for (std::size_t i = 1; i < way.size(); ++i) {
        EXPECT_EQ(sim::obstacle_on(world.plan, way[i - 1].at, way[i].at).value_or(""), "");
      }
    }
  }
}

TEST(Building, ChangesFromSessionToSessionAndIsOtherwiseTheSame) {
  const Building building(3);
  const sim::World before = building.session(0, 5);
  const sim::World again = Building(3).session(0, 5);
  const sim::World later = building.session(1, 5);
  int changed = 0;
  for (int row = 0; row < before.plan.rows(); ++row) {
    for (int column = 0; column < before.plan.columns(); ++column) {
      const sim::Cell cell{column, row};
      ASSERT_EQ(before.plan.is_wall(cell), again.plan.is_wall(cell));
      changed += before.plan.is_wall(cell) != later.plan.is_wall(cell) ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < before.tours.front().waypoints.size(); ++i) {
    EXPECT_EQ(before.tours.front().waypoints[i].name, again.tours.front().waypoints[i].name);
  }
  EXPECT_GT(changed, 100);
  EXPECT_LT(changed, before.plan.rows() * before.plan.columns() / 10);
}

/// Numbers drawn from two bells two deviations apart: their log-likelihood ratio is 2 x.
std::vector<Example> two_bells(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Example> examples;
  for (int i = 0; i < count; ++i) {
    const bool is_same = i % 5 == 0;  // Rare, which must not matter.
    examples.push_back({Eigen::Vector2d(1.0, normal(random) + (is_same ? 1.0 : -1.0)), is_same});
  }
  return examples;
}

std::vector<Judgement> judged(const std::vector<Example>& examples, double factor) {
  std::vector<Judgement> judgements;
  for (const Example& example : examples) {
    judgements.push_back({factor * example.features[1], example.is_same});
  }
  return judgements;
}

TEST(RecognitionFit, FindsTheLikelihoodRatioWhateverTheShareOfTheSame) {
  const Eigen::VectorXd weights = fitted_weights(two_bells(20'000, 1));
  EXPECT_NEAR(weights[0], 0.0, 0.15);
  EXPECT_NEAR(weights[1], 2.0, 0.15);
}

TEST(RecognitionFit, TheTrueRatioHasTheLeastLossAndIsReliable) {
  const std::vector<Example> examples = two_bells(20'000, 2);
  const double least = log_loss(judged(examples, 2.0));
  EXPECT_LT(least, log_loss(judged(examples, 1.0)));
  EXPECT_LT(least, log_loss(judged(examples, 6.0)));
  EXPECT_NEAR(log_loss(judged(examples, 0.0)), std::log(2.0), 1e-9);
  for (const ReliabilityBin& bin : reliability(judged(examples, 2.0))) {
    if (bin.same > 50 && bin.different > 50) {
      EXPECT_NEAR(bin.predicted, bin.actual, 0.05) << bin.low;
    }
  }
}

TEST(RecognitionFit, AHigherThresholdTradesFalseMatchesForMissedOnes) {
  const std::vector<Judgement> judgements = judged(two_bells(2'000, 3), 2.0);
  ErrorRates last = error_rates(judgements, -100.0);
  EXPECT_EQ(last.missed_matches, 0.0);
  EXPECT_NEAR(last.false_matches, 1.0, 1e-9);
  for (double threshold = -6.0; threshold <= 6.0; threshold += 1.0) {
    const ErrorRates rates = error_rates(judgements, threshold);
    EXPECT_LE(rates.false_matches, last.false_matches);
    EXPECT_GE(rates.missed_matches, last.missed_matches);
    last = rates;
  }
}

// In a building that the ratio was not fitted to.
TEST(Recognition, TellsJunctionsOfAnotherBuildingFromEachOther) {
  int same = 0;
  int taken_for_same = 0;
  int different = 0;
  int told_apart = 0;
  std::vector<double> chi2;
  for (const JudgedPair& pair : judged_buildings(1001, 1)) {
    (pair.is_same ? same : different) += 1;
    taken_for_same += pair.is_same && pair.match.log_likelihood_ratio > 0.0 ? 1 : 0;
    told_apart += !pair.is_same && pair.match.log_likelihood_ratio < 0.0 ? 1 : 0;
    EXPECT_LE(std::abs(pair.match.log_likelihood_ratio), 7.0);
    if (pair.is_same) {
      chi2.push_back(pair.chi2);
    }
  }
  ASSERT_GT(same, 10);
  ASSERT_GT(different, 100);
  EXPECT_GT(taken_for_same, 0.85 * same);
  EXPECT_GT(told_apart, 0.9 * different);
  // The alignment is as sure as it says it is: the median of chi2 with three degrees is 2.4.
  std::nth_element(chi2.begin(), chi2.begin() + same / 2, chi2.end());
  const double median_of_chi2 = chi2[static_cast<std::size_t>(same / 2)];
  EXPECT_LT(median_of_chi2, 4.0);
  EXPECT_GT(median_of_chi2, 0.2);
}

}  // namespace
}  // namespace cairn::lab
