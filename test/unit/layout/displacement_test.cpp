#include "layout/displacement.hpp"

#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace cairn {
namespace {

Matrix3d diagonal(double x, double y, double theta) {
  return Eigen::Vector3d(x * x, y * y, theta * theta).asDiagonal();
}

Pose2 sample(const GaussianPose& pose, std::mt19937* random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector3d unit(normal(*random), normal(*random), normal(*random));
  const Matrix3d lower = pose.covariance.llt().matrixL();
  const Eigen::Vector3d shift = lower * unit;
  return {pose.mean.x() + shift.x(), pose.mean.y() + shift.y(), pose.mean.theta() + shift.z()};
}

TEST(Displacement, LeadsFromTheFrameOfDepartureToThatOfArrival) {
  const Pose2 T_a_robot(1.0, 2.0, 0.5);
  const Pose2 T_departure_arrival(10.0, -3.0, 1.5);
  const Pose2 T_b_robot(-0.5, 0.25, -2.5);
  const Matrix3d small = diagonal(0.01, 0.01, 0.01);
  const GaussianPose T_a_b =
      displacement({T_a_robot, small}, {T_departure_arrival, small}, {T_b_robot, small});
  const Pose2 round_trip = T_a_b.mean * T_b_robot;
  const Pose2 expected = T_a_robot * T_departure_arrival;
  EXPECT_NEAR(round_trip.x(), expected.x(), 1e-12);
  EXPECT_NEAR(round_trip.y(), expected.y(), 1e-12);
  EXPECT_NEAR(turn_between(round_trip.theta(), expected.theta()), 0.0, 1e-12);
}

TEST(Displacement, HasTheCovarianceOfItsSampledParts) {
  const GaussianPose departure{{0.3, -0.2, 2.0}, diagonal(0.02, 0.05, 0.01)};
  const GaussianPose travel{{12.0, 4.0, -1.2}, diagonal(0.2, 0.1, 0.02)};
  const GaussianPose arrival{{1.0, 0.5, 0.7}, diagonal(0.03, 0.02, 0.015)};
  const GaussianPose expected = displacement(departure, travel, arrival);
  ASSERT_TRUE(validate_displacement(expected));

  std::mt19937 random(7);
  constexpr int kSamples = 20000;
  Matrix3d sum = Matrix3d::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const Pose2 T_from_to =
        sample(departure, &random) * sample(travel, &random) * sample(arrival, &random).inverse();
    const Eigen::Vector3d error(T_from_to.x() - expected.mean.x(),
                                T_from_to.y() - expected.mean.y(),
                                turn_between(expected.mean.theta(), T_from_to.theta()));
    sum += error * error.transpose();
  }
  const Matrix3d sampled = sum / kSamples;
  EXPECT_LT((sampled - expected.covariance).norm(), 0.05 * expected.covariance.norm());
}

TEST(Displacement, BackwardsIsTheInverse) {
  const GaussianPose departure{{0.3, -0.2, 2.0}, diagonal(0.02, 0.05, 0.01)};
  const GaussianPose travel{{12.0, 4.0, -1.2}, diagonal(0.2, 0.1, 0.02)};
  const GaussianPose arrival{{1.0, 0.5, 0.7}, diagonal(0.03, 0.02, 0.015)};
  const GaussianPose there = displacement(departure, travel, arrival);
  const GaussianPose back = displacement(arrival, inverted(travel), departure);
  EXPECT_LT((inverted(there).covariance - back.covariance).norm(), 1e-10);
}

TEST(Displacement, IsRefusedWithoutAnUncertaintyOfItsOwn) {
  EXPECT_TRUE(validate_displacement({{1.0, 0.0, 0.0}, diagonal(0.1, 0.1, 0.1)}));
  EXPECT_FALSE(validate_displacement({{1.0, 0.0, 0.0}, Matrix3d::Zero()}));
  EXPECT_FALSE(validate_displacement({{1.0, 0.0, 0.0}, diagonal(1e-9, 0.1, 0.1)}));
  EXPECT_FALSE(validate_displacement({{1.0, 0.0, 0.0}, diagonal(0.1, 1e7, 0.1)}));
  EXPECT_FALSE(validate_displacement({{NAN, 0.0, 0.0}, diagonal(0.1, 0.1, 0.1)}));
  Matrix3d negative = diagonal(0.1, 0.1, 0.1);
  negative(0, 0) = -0.01;
  EXPECT_FALSE(validate_displacement({{1.0, 0.0, 0.0}, negative}));
  Matrix3d unsymmetric = diagonal(0.1, 0.1, 0.1);
  unsymmetric(0, 1) = 0.001;
  EXPECT_FALSE(validate_displacement({{1.0, 0.0, 0.0}, unsymmetric}));
}

}  // namespace
}  // namespace cairn
