#include "layout/closure_screen.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Matrix3d isotropic(double sigma) {
  return sigma * sigma * Matrix3d::Identity();
}

/// A square walked counterclockwise, 10 m a side.
std::vector<TravelConstraint> three_sides(double sigma) {
  const GaussianPose side{{10.0, 0.0, kPi / 2.0}, isotropic(sigma)};
  return {{0, 1, side}, {1, 2, side}, {2, 3, side}};
}

TEST(ClosureScreen, PredictsTheChainOfTravels) {
  const Result<GaussianPose> predicted = chained_displacement(4, three_sides(0.1), 3, 0);
  ASSERT_TRUE(predicted);
  EXPECT_NEAR(predicted->mean.x(), 10.0, 1e-9);
  EXPECT_NEAR(predicted->mean.y(), 0.0, 1e-9);
  EXPECT_NEAR(predicted->mean.theta(), kPi / 2.0, 1e-9);
  EXPECT_TRUE(is_positive_definite(predicted->covariance));
}

TEST(ClosureScreen, TakesTheLeastUncertainOfTwoWays) {
  std::vector<TravelConstraint> travels = three_sides(0.01);
  travels.push_back({0, 3, {{1.0, 1.0, 0.0}, isotropic(5.0)}});
  const Result<GaussianPose> predicted = chained_displacement(4, travels, 0, 3);
  ASSERT_TRUE(predicted);
  EXPECT_NEAR(predicted->mean.y(), 10.0, 1e-9);
}

TEST(ClosureScreen, TellsATrueClosureFromAFalseOne) {
  const std::vector<TravelConstraint> travels = three_sides(0.05);
  const Result<double> closed =
      closure_chi2(4, travels, {3, 0, {{10.1, 0.1, kPi / 2.0}, isotropic(0.05)}});
  const Result<double> astray =
      closure_chi2(4, travels, {3, 0, {{14.0, 0.0, kPi / 2.0}, isotropic(0.05)}});
  ASSERT_TRUE(closed);
  ASSERT_TRUE(astray);
  EXPECT_LT(*closed, 1.0);
  EXPECT_GT(*astray, 16.3);
}

TEST(ClosureScreen, OfAPlaceWithItselfComparesWithNoMotion) {
  const Result<double> chi2 =
      closure_chi2(4, three_sides(0.05), {2, 2, {{0.3, 0.0, 0.0}, isotropic(0.1)}});
  ASSERT_TRUE(chi2);
  EXPECT_NEAR(*chi2, 9.0, 1e-9);
}

TEST(ClosureScreen, SaysWhyThereIsNoPrediction) {
  const Result<GaussianPose> none = chained_displacement(5, three_sides(0.1), 0, 4);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  const Result<GaussianPose> unknown = chained_displacement(4, three_sides(0.1), 0, 4);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kInvalidValue);
  EXPECT_FALSE(closure_chi2(4, three_sides(0.1), {0, 3, {{0.0, 0.0, 0.0}, Matrix3d::Zero()}}));
}

}  // namespace
}  // namespace cairn
