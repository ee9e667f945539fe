#include "layout/consistency.hpp"

#include <random>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Matrix3d covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

/// A ring of places with chords, travelled with the noise that the travels admit.
std::vector<TravelConstraint> ring_with_chords(unsigned seed, int places) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto truth = [places](int place) {
    const double angle_rad = 2.0 * kPi * place / places;
    return Pose2(10.0 * std::cos(angle_rad), 10.0 * std::sin(angle_rad), angle_rad);
  };
  std::vector<TravelConstraint> travels;
  const auto travel = [&](int from, int to) {
    const Pose2 step = truth(from).inverse() * truth(to);
    const Pose2 seen(step.x() + 0.1 * normal(random), step.y() + 0.1 * normal(random),
                     step.theta() + 0.02 * normal(random));
    travels.push_back({from, to, {seen, covariance(0.1, 0.02)}});
  };
  for (int i = 0; i < places; ++i) {
    travel(i, (i + 1) % places);
  }
  for (int i = 0; i < places; i += 3) {
    travel(i, (i + places / 2) % places);
  }
  return travels;
}

TEST(NormalDeviate, IsThatOfTheSameProbability) {
  // Quantiles of chi2 with 3 degrees of freedom at the one-sided normal deviates.
  EXPECT_NEAR(normal_deviate_of_chi2(7.815), 1.645, 0.02);
  EXPECT_NEAR(normal_deviate_of_chi2(11.345), 2.326, 0.02);
  EXPECT_NEAR(normal_deviate_of_chi2(16.266), 3.090, 0.05);
  EXPECT_EQ(normal_deviate_of_chi2(0.0), 0.0);
}

class Agreements : public ::testing::TestWithParam<unsigned> {};

// The definition, done the long way.
TEST_P(Agreements, AreThoseOfLayoutsThatLeaveTheTravelOut) {
  constexpr int kPlaces = 12;
  const std::vector<TravelConstraint> travels = ring_with_chords(GetParam(), kPlaces);
  const Result<PlaceLayout> all = solve_layout(kPlaces, travels);
  ASSERT_TRUE(all);
  const Result<std::vector<Agreement>> agreements = agreements_of(*all, travels);
  ASSERT_TRUE(agreements);
  for (std::size_t i = 0; i < travels.size(); ++i) {
    std::vector<TravelConstraint> others = travels;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Result<PlaceLayout> without = solve_layout(kPlaces, others);
    ASSERT_TRUE(without);
    // By how much the travel strains the layout is its squared distance from what others predict.
    EXPECT_NEAR((*agreements)[i].chi2, all->chi2 - without->chi2,
                0.03 * (1.0 + all->chi2 - without->chi2));
  }
}

TEST_P(Agreements, PointAtTheTravelThatIsWrong) {
  constexpr int kPlaces = 12;
  std::vector<TravelConstraint> travels = ring_with_chords(GetParam(), kPlaces);
  // A chord: of travels in a row nobody could tell which is wrong.
  const std::size_t wrong = kPlaces + GetParam() % (travels.size() - kPlaces);
  GaussianPose& lie = travels[wrong].T_from_to;
  lie.mean = Pose2(lie.mean.x() + 1.5, lie.mean.y(), lie.mean.theta());
  const Result<PlaceLayout> layout = solve_layout(kPlaces, travels);
  ASSERT_TRUE(layout);
  const Result<std::vector<Agreement>> agreements = agreements_of(*layout, travels);
  ASSERT_TRUE(agreements);
  for (std::size_t i = 0; i < travels.size(); ++i) {
    if (i != wrong) {
      EXPECT_LT((*agreements)[i].sigmas, (*agreements)[wrong].sigmas);
    }
  }
  EXPECT_GT((*agreements)[wrong].sigmas, 4.0);
}

TEST_P(Agreements, HaveTheChi2OfThreeDegreesOfFreedom) {
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 100 * GetParam(); seed < 100 * GetParam() + 20; ++seed) {
    const std::vector<TravelConstraint> travels = ring_with_chords(seed, 12);
    const Result<PlaceLayout> layout = solve_layout(12, travels);
    const Result<std::vector<Agreement>> agreements = agreements_of(*layout, travels);
    for (const Agreement& agreement : *agreements) {
      sum += agreement.chi2;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 3.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Agreements, ::testing::Range(1U, 7U));

TEST(AgreementOfATree, IsWhatNothingContradicts) {
  const std::vector<TravelConstraint> travels = {{0, 1, {Pose2(1, 0, 0), covariance(0.1, 0.1)}},
                                                 {1, 2, {Pose2(1, 2, 0.5), covariance(0.1, 0.1)}},
                                                 {2, 2, {Pose2(9, 9, 0.5), covariance(0.1, 0.1)}}};
  const Result<std::vector<Agreement>> agreements =
      agreements_of(*solve_layout(3, travels), travels);
  ASSERT_TRUE(agreements);
  for (const Agreement& agreement : *agreements) {
    EXPECT_NEAR(agreement.chi2, 0.0, 1e-9);
    EXPECT_NEAR(agreement.checked_share, 0.0, 1e-9);
  }
}

TEST(AgreementOfATree, OfOnePlaceIsNothing) {
  EXPECT_TRUE(agreements_of(*solve_layout(1, {}), {})->empty());
}

}  // namespace
}  // namespace cairn
