#include "layout/place_layout.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "layout/damped_descent.hpp"
#include "layout/layout_attempt.hpp"
#include "layout/linear_start.hpp"
#include "layout/normal_equations.hpp"
#include "layout/travel_residual.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;

Matrix3d diagonal(double x, double y, double theta) {
  return Eigen::Vector3d(x * x, y * y, theta * theta).asDiagonal();
}

/// A walk of random travels with some returns, measured with noise.
struct World {
  std::vector<Pose2> T_global_place;
  std::vector<TravelConstraint> travels;
};

World random_world(unsigned seed, int place_count, int loop_count) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-kPi, kPi);
  World world;
  for (int i = 0; i < place_count; ++i) {
    world.T_global_place.emplace_back(5.0 * uniform(random), 5.0 * uniform(random),
                                      uniform(random));
  }
  world.T_global_place.front() = Pose2();
  const auto travel = [&](int from, int to) {
    const Pose2 T_from_to = world.T_global_place[static_cast<std::size_t>(from)].inverse() *
                            world.T_global_place[static_cast<std::size_t>(to)];
    world.travels.push_back(
        {from,
         to,
         {Pose2(T_from_to.x() + 0.1 * normal(random), T_from_to.y() + 0.2 * normal(random),
                T_from_to.theta() + 0.03 * normal(random)),
          diagonal(0.1, 0.2, 0.03)}});
  };
  for (int i = 1; i < place_count; ++i) {
    travel(i - 1, i);
  }
  for (int i = 0; i < loop_count; ++i) {
    const int from = static_cast<int>(random() % static_cast<unsigned>(place_count));
    travel(from, (from + 2 + static_cast<int>(random() % 5)) % place_count);
  }
  return world;
}

PlaceLayout layout_of(int place_count,
                      const std::vector<TravelConstraint>& travels,
                      const LayoutOptions& options = {}) {
  const Result<PlaceLayout> layout = solve_layout(place_count, travels, options);
  EXPECT_TRUE(layout) << (layout ? "" : layout.error().message);
  return layout ? *layout : PlaceLayout{};
}

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
  EXPECT_NEAR(turn_between(a.theta(), b.theta()), 0.0, tolerance);
}

TEST(PlaceLayout, OfATreeFollowsItsTravelsExactly) {
  World world = random_world(1, 12, 0);
  const PlaceLayout layout = layout_of(12, world.travels);
  EXPECT_NEAR(layout.chi2, 0.0, 1e-9);
  Pose2 chained;
  for (std::size_t i = 0; i < world.travels.size(); ++i) {
    chained = chained * world.travels[i].T_from_to.mean;
    expect_near(layout.T_global_place[i + 1], chained, 1e-6);
  }
}

TEST(PlaceLayout, OfOnePlaceIsTheOrigin) {
  const PlaceLayout layout = layout_of(1, {});
  ASSERT_EQ(layout.T_global_place.size(), 1U);
  EXPECT_EQ(layout.T_global_place.front(), Pose2());
  EXPECT_EQ(layout.chi2, 0.0);
  EXPECT_EQ(layout.log_likelihood, 0.0);
}

TEST(PlaceLayout, SharesTheErrorOfALoopByUncertainty) {
  const Matrix3d sure = diagonal(0.1, 0.1, 0.01);
  const Matrix3d unsure = diagonal(0.3, 0.3, 0.01);
  const PlaceLayout layout =
      layout_of(2, {{0, 1, {{1.0, 0.0, 0.0}, sure}}, {0, 1, {{2.0, 0.0, 0.0}, unsure}}});
  expect_near(layout.T_global_place[1], {1.1, 0.0, 0.0}, 1e-6);
  EXPECT_NEAR(layout.chi2, 1.0 + 9.0, 1e-6);
  EXPECT_NEAR(layout.chi2_of_travel[0], 1.0, 1e-6);
  EXPECT_NEAR(layout.chi2_of_travel[1], 9.0, 1e-6);
}

// One metre of error where the deviation is 1 / sqrt(2) m: exp(-1) of the density at the mode.
TEST(PlaceLayout, LogLikelihoodIsThatOfTheGaussianDensity) {
  const Matrix3d covariance = diagonal(0.5, 0.5, 0.5);
  const PlaceLayout layout =
      layout_of(2, {{0, 1, {{0.0, 0.0, 0.0}, covariance}}, {0, 1, {{1.0, 0.0, 0.0}, covariance}}});
  const double log_norm = -0.5 * std::log((2.0 * kPi * covariance).determinant());
  EXPECT_NEAR(layout.chi2, 2.0, 1e-6);
  EXPECT_NEAR(layout.log_likelihood, -1.0 + 2.0 * log_norm, 1e-6);
}

TEST(PlaceLayout, ALoopPathCountsButMovesNothing) {
  const Matrix3d covariance = diagonal(0.1, 0.1, 0.1);
  const PlaceLayout layout =
      layout_of(2, {{0, 1, {{3.0, 0.0, 1.0}, covariance}}, {1, 1, {{0.2, 0.0, 0.0}, covariance}}});
  expect_near(layout.T_global_place[1], {3.0, 0.0, 1.0}, 1e-9);
  EXPECT_NEAR(layout.chi2, 4.0, 1e-9);
}

TEST(PlaceLayout, KeepsHeadingsAcrossTheTurnOfTheCircle) {
  const Matrix3d covariance = diagonal(0.1, 0.1, 0.1);
  const PlaceLayout layout =
      layout_of(2, {{0, 1, {{1.0, 0.0, 3.1}, covariance}}, {0, 1, {{1.0, 0.0, -3.1}, covariance}}});
  EXPECT_NEAR(std::abs(layout.T_global_place[1].theta()), kPi, 1e-6);
  EXPECT_NEAR(layout.chi2, 2.0 * std::pow((kPi - 3.1) / 0.1, 2), 1e-6);
}

TEST(PlaceLayout, DoesNotDependOnTheOrderOfTravels) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    World world = random_world(seed, 20, 12);
    const PlaceLayout layout = layout_of(20, world.travels);
    std::shuffle(world.travels.begin(), world.travels.end(), std::mt19937(seed));
    const PlaceLayout shuffled = layout_of(20, world.travels);
    EXPECT_NEAR(layout.chi2, shuffled.chi2, 1e-6 * (1.0 + layout.chi2));
    EXPECT_NEAR(layout.log_likelihood, shuffled.log_likelihood, 1e-6 * (1.0 + layout.chi2));
    for (std::size_t i = 0; i < 20; ++i) {
      expect_near(layout.T_global_place[i], shuffled.T_global_place[i], 1e-4);
    }
  }
}

TEST(PlaceLayout, DoesNotDependOnTheNumbersOfPlacesButForItsFrame) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    World world = random_world(seed, 15, 10);
    const PlaceLayout layout = layout_of(15, world.travels);
    std::vector<int> number(15);
    for (int i = 0; i < 15; ++i) {
      number[static_cast<std::size_t>(i)] = i;
    }
    std::shuffle(number.begin(), number.end(), std::mt19937(seed));
    for (TravelConstraint& travel : world.travels) {
      travel.from = number[static_cast<std::size_t>(travel.from)];
      travel.to = number[static_cast<std::size_t>(travel.to)];
    }
    const PlaceLayout renamed = layout_of(15, world.travels);
    EXPECT_NEAR(layout.chi2, renamed.chi2, 1e-6 * (1.0 + layout.chi2));
    const Pose2 T_renamed_global = renamed.T_global_place[static_cast<std::size_t>(number[0])];
    for (std::size_t i = 0; i < 15; ++i) {
      expect_near(T_renamed_global * layout.T_global_place[i],
                  renamed.T_global_place[static_cast<std::size_t>(number[i])], 1e-4);
    }
  }
}

TEST(PlaceLayout, DoesNotDependOnWholeTurnsOfMeasuredHeadings) {
  World world = random_world(3, 15, 8);
  const PlaceLayout layout = layout_of(15, world.travels);
  for (TravelConstraint& travel : world.travels) {
    const Pose2& mean = travel.T_from_to.mean;
    travel.T_from_to.mean = Pose2(mean.x(), mean.y(), mean.theta() + 2.0 * kPi);
  }
  EXPECT_NEAR(layout_of(15, world.travels).chi2, layout.chi2, 1e-6);
}

// The covariance is turned about the measured end: exact only where travels agree, else nearly.
TEST(PlaceLayout, ATravelSaysNearlyTheSameBackwards) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    World world = random_world(seed, 10, 6);
    const PlaceLayout layout = layout_of(10, world.travels);
    for (TravelConstraint& travel : world.travels) {
      travel = {travel.to, travel.from, inverted(travel.T_from_to)};
    }
    EXPECT_NEAR(layout_of(10, world.travels).chi2, layout.chi2, 0.1 * layout.chi2 + 0.1);
  }
}

TEST(PlaceLayout, IsTheSameBitForBitForTheSameInput) {
  const World world = random_world(5, 30, 20);
  LayoutOptions options;
  options.covariances = true;
  const PlaceLayout first = layout_of(30, world.travels, options);
  const PlaceLayout second = layout_of(30, world.travels, options);
  EXPECT_EQ(first.T_global_place, second.T_global_place);
  EXPECT_EQ(first.chi2_of_travel, second.chi2_of_travel);
  EXPECT_EQ(first.covariances, second.covariances);
}

TEST(PlaceLayout, HasTheChi2OfItsDegreesOfFreedom) {
  double sum = 0.0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const World world = random_world(seed, 20, 20);
    sum += layout_of(20, world.travels).chi2;
  }
  EXPECT_NEAR(sum / 50.0, 3.0 * (39 - 19), 5.0);
}

TEST(PlaceLayout, GoesOnFromAnEarlierLayoutToTheSameOptimum) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const World world = random_world(seed, 20, 12);
    std::vector<TravelConstraint> first_travels(world.travels.begin(), world.travels.begin() + 14);
    const PlaceLayout earlier = layout_of(15, first_travels);
    const Result<PlaceLayout> later = solve_layout(20, world.travels, {}, &earlier);
    ASSERT_TRUE(later) << later.error().message;
    const PlaceLayout afresh = layout_of(20, world.travels);
    EXPECT_NEAR(later->chi2, afresh.chi2, 1e-6 * (1.0 + afresh.chi2));
  }
}

TEST(PlaceLayout, DampedStepsFindTheSameOptimum) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const World world = random_world(seed, 20, 12);
    std::vector<TravelResidual> residuals;
    for (const TravelConstraint& travel : world.travels) {
      residuals.push_back(residual_of(travel));
    }
    PlaceVector places = linear_start(20, world.travels);
    ASSERT_TRUE(descend_damped(residuals, {}, &places));
    const double chi2 = layout_of(20, world.travels).chi2;
    EXPECT_NEAR(cost_of(places, residuals, 0.0), chi2, 1e-6 * (1.0 + chi2));
  }
}

TEST(PlaceLayout, AWildTravelIsOutvotedWhereOutliersAreExpected) {
  const Matrix3d covariance = diagonal(0.1, 0.1, 0.02);
  std::vector<TravelConstraint> travels;
  for (int i = 0; i < 4; ++i) {
    travels.push_back({0, 1, {{5.0, 0.0, 0.0}, covariance}});
  }
  travels.push_back({0, 1, {{9.0, 0.0, 0.0}, covariance}});
  LayoutOptions robust;
  robust.outlier_sigmas = 2.0;
  EXPECT_NEAR(layout_of(2, travels).T_global_place[1].x(), 5.8, 1e-6);
  EXPECT_NEAR(layout_of(2, travels, robust).T_global_place[1].x(), 5.05, 1e-3);
}

TEST(PlaceLayout, CovariancesAreTheBlocksOfTheInverseCurvature) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    constexpr int kPlaces = 40;
    const World world = random_world(seed, kPlaces, 30);
    LayoutOptions options;
    options.covariances = true;
    const PlaceLayout layout = layout_of(kPlaces, world.travels, options);
    Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(3 * kPlaces, 3 * kPlaces);
    for (const TravelConstraint& travel : world.travels) {
      const auto place = [&](int number) {
        const Pose2& pose = layout.T_global_place[static_cast<std::size_t>(number)];
        return Eigen::Vector3d(pose.x(), pose.y(), pose.theta());
      };
      Matrix3d by_from;
      Matrix3d by_to;
      static_cast<void>(
          residual_of(travel).at(place(travel.from), place(travel.to), &by_from, &by_to));
      const auto add = [&](int a, int b, const Matrix3d& block) {
        curvature.block<3, 3>(3 * a, 3 * b) += block;
      };
      add(travel.from, travel.from, by_from.transpose() * by_from);
      add(travel.to, travel.to, by_to.transpose() * by_to);
      add(travel.from, travel.to, by_from.transpose() * by_to);
      add(travel.to, travel.from, by_to.transpose() * by_from);
    }
    const Eigen::Index free = 3 * kPlaces - 3;
    const Eigen::MatrixXd inverse = curvature.bottomRightCorner(free, free).inverse();
    for (Eigen::Index i = 0; i + 1 < kPlaces; ++i) {
      const Matrix3d& found = layout.covariances[static_cast<std::size_t>(i) + 1];
      EXPECT_LT((found - inverse.block<3, 3>(3 * i, 3 * i)).norm(), 1e-6 * found.norm());
    }
  }
}

TEST(PlaceLayout, UncertaintyGrowsAlongATreeAndShrinksByALoop) {
  World world = random_world(2, 8, 0);
  LayoutOptions options;
  options.covariances = true;
  const PlaceLayout tree = layout_of(8, world.travels, options);
  GaussianPose chained;
  for (std::size_t i = 0; i + 1 < 8; ++i) {
    chained = compounded(chained, world.travels[i].T_from_to);
    EXPECT_LT((tree.covariances[i + 1] - chained.covariance).norm(),
              1e-6 * chained.covariance.norm());
  }
  EXPECT_EQ(tree.covariances[0], Matrix3d::Zero());
  world.travels.push_back({0, 7, chained});
  const PlaceLayout loop = layout_of(8, world.travels, options);
  EXPECT_LT(loop.covariances[7].trace(), 0.51 * tree.covariances[7].trace());
}

TEST(PlaceLayout, NamesThePlaceThatNoTravelReaches) {
  const Matrix3d covariance = diagonal(0.1, 0.1, 0.1);
  const Result<PlaceLayout> layout = solve_layout(
      4, {{0, 1, {{1.0, 0.0, 0.0}, covariance}}, {2, 3, {{1.0, 0.0, 0.0}, covariance}}});
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().code, ErrorCode::kContradiction);
  EXPECT_THAT(layout.error().message, HasSubstr("to place 2"));
}

TEST(LayoutAttempt, EndsNearTheStartItIsGiven) {
  const World world = random_world(4, 20, 12);
  const Result<LayoutAttempt> linear = attempt_layout(20, world.travels);
  ASSERT_TRUE(linear);
  EXPECT_TRUE(linear->is_converged);
  EXPECT_GE(linear->initial_chi2, linear->layout.chi2);
  const Result<LayoutAttempt> from_truth =
      attempt_layout(20, world.travels, {}, &world.T_global_place);
  ASSERT_TRUE(from_truth);
  EXPECT_TRUE(from_truth->is_converged);
  EXPECT_NEAR(from_truth->layout.chi2, linear->layout.chi2, 1e-6 * linear->layout.chi2);
}

TEST(LayoutAttempt, SaysWhyThereIsNoLayout) {
  const World world = random_world(4, 20, 12);
  std::vector<Pose2> far = world.T_global_place;
  far[3] = Pose2(1e300, 1e300, 0.0);
  const Result<LayoutAttempt> attempt = attempt_layout(20, world.travels, {}, &far);
  ASSERT_TRUE(attempt);
  EXPECT_FALSE(attempt->is_converged);
  EXPECT_THAT(attempt->reason, HasSubstr("not finite"));
  far[3] = Pose2(NAN, 0.0, 0.0);
  EXPECT_FALSE(attempt_layout(20, world.travels, {}, &far));
  far.pop_back();
  EXPECT_FALSE(attempt_layout(20, world.travels, {}, &far));
}

TEST(PlaceLayout, RefusesBadTravelsByNumber) {
  const Matrix3d covariance = diagonal(0.1, 0.1, 0.1);
  const auto refused = [&](const TravelConstraint& travel) {
    const Result<PlaceLayout> layout =
        solve_layout(2, {{0, 1, {{1.0, 0.0, 0.0}, covariance}}, travel});
    return !layout && layout.error().code == ErrorCode::kInvalidValue &&
           layout.error().message.find("travel 1") != std::string::npos;
  };
  EXPECT_TRUE(refused({0, 2, {{1.0, 0.0, 0.0}, covariance}}));
  EXPECT_TRUE(refused({-1, 1, {{1.0, 0.0, 0.0}, covariance}}));
  EXPECT_TRUE(refused({0, 1, {{1.0, 0.0, 0.0}, -covariance}}));
  EXPECT_TRUE(refused({0, 1, {{1.0, INFINITY, 0.0}, covariance}}));
  EXPECT_FALSE(solve_layout(0, {}));
  LayoutOptions bad;
  bad.outlier_sigmas = NAN;
  EXPECT_FALSE(solve_layout(1, {}, bad));
}

}  // namespace
}  // namespace cairn
