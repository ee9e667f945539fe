#include "layout/exclusion.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

GaussianPose step(double x_m, double y_m, double sigma_m) {
  return {Pose2(x_m, y_m, 0.0), Eigen::Vector3d(sigma_m, sigma_m, 0.01).cwiseAbs2().asDiagonal()};
}

/// Round a square and back to the start, which is not known to be the start.
struct Square {
  explicit Square(double sigma_m, double short_of_m = 0.2) {
    layout.T_global_place = {Pose2(), Pose2(5, 0, 0), Pose2(5, 5, 0), Pose2(0, 5, 0),
                             Pose2(0, short_of_m, 0)};
    travels = {{0, 1, step(5, 0, sigma_m)},
               {1, 2, step(0, 5, sigma_m)},
               {2, 3, step(-5, 0, sigma_m)},
               {3, 4, step(0, short_of_m - 5, sigma_m)}};
  }
  PlaceLayout layout;
  std::vector<TravelConstraint> travels;
};

TEST(LogExclusion, NothingSpeaksAgainstPlacesFarFromEachOther) {
  const Square square(0.02, 2.5);
  EXPECT_EQ(log_exclusion(square.layout.T_global_place, square.travels, {}), 0.0);
  EXPECT_EQ(log_exclusion(std::vector<Pose2>{}, {}, {}), 0.0);
}

TEST(LogExclusion, TwoPlacesSurelyAtOneSpotCountAsTheLeast) {
  const Square square(0.02);
  EXPECT_DOUBLE_EQ(log_exclusion(square.layout.T_global_place, square.travels, {0.7, -7.0}), -7.0);
  EXPECT_DOUBLE_EQ(log_exclusion(square.layout.T_global_place, square.travels, {0.7, -20.0}),
                   -20.0);
}

TEST(LogExclusion, TheLessIsKnownOfTheDistanceTheLessItSays) {
  double last = -8.0;
  for (const double sigma_m : {0.05, 0.3, 0.6, 1.5, 5.0}) {
    const Square square(sigma_m);
    const double log = log_exclusion(square.layout.T_global_place, square.travels, {});
    EXPECT_GT(log, last) << sigma_m;
    last = log;
  }
  EXPECT_GT(last, -0.05);
  EXPECT_LT(last, 0.0);
}

TEST(LogExclusion, IsTheProbabilityOfASquareForANormalDistribution) {
  PlaceLayout layout;
  layout.T_global_place = {Pose2(), Pose2(0.5, 0, 0)};
  const double sigma_m = 0.5;
  const std::vector<TravelConstraint> travels = {{0, 1, step(0.5, 0, sigma_m)}};
  const auto cdf = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  const double near = (cdf(1.0) - cdf(-3.0)) * (cdf(2.0) - cdf(-2.0));
  EXPECT_NEAR(log_exclusion(layout.T_global_place, travels, {1.0}), std::log(1.0 - near), 1e-9);
}

TEST(LogExclusion, GoesByTheSurestWay) {
  Square square(5.0);
  const double by_the_way_around = log_exclusion(square.layout.T_global_place, square.travels, {});
  square.travels.push_back({0, 4, step(0, 0.2, 0.02)});
  EXPECT_DOUBLE_EQ(log_exclusion(square.layout.T_global_place, square.travels, {}), -7.0);
  EXPECT_GT(by_the_way_around, -0.1);
}

TEST(LogExclusion, DoesNotDependOnTheFrame) {
  const Square square(0.4);
  PlaceLayout moved = square.layout;
  for (Pose2& pose : moved.T_global_place) {
    pose = Pose2(3.0, -7.0, 2.0) * pose;
  }
  EXPECT_NEAR(log_exclusion(moved.T_global_place, square.travels, {}),
              log_exclusion(square.layout.T_global_place, square.travels, {}), 1e-9);
}

}  // namespace
}  // namespace cairn
