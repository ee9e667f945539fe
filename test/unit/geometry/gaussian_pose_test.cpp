#include "geometry/gaussian_pose.hpp"

#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>

namespace cairn {
namespace {

Pose2 drawn(const GaussianPose& pose, std::mt19937* random) {
  std::normal_distribution<double> unit;
  const Matrix3d root = pose.covariance.llt().matrixL();
  const Eigen::Vector3d d = root * Eigen::Vector3d(unit(*random), unit(*random), unit(*random));
  return {pose.mean.x() + d.x(), pose.mean.y() + d.y(), pose.mean.theta() + d.z()};
}

Matrix3d sampled_covariance(const std::vector<Pose2>& samples, const Pose2& mean) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Pose2& sample : samples) {
    const Eigen::Vector3d d(sample.x() - mean.x(), sample.y() - mean.y(),
                            turn_between(mean.theta(), sample.theta()));
    sum += d * d.transpose();
  }
  return sum / static_cast<double>(samples.size());
}

const GaussianPose kFirst{Pose2(3.0, -1.0, 0.7),
                          Eigen::Vector3d(4e-4, 1e-4, 9e-5).asDiagonal().toDenseMatrix()};
const GaussianPose kSecond{Pose2(5.0, 2.0, -2.0),
                           Eigen::Vector3d(1e-4, 9e-4, 4e-5).asDiagonal().toDenseMatrix()};

TEST(GaussianPose, CompoundsAsItsSamplesDo) {
  std::mt19937 random(1);
  const GaussianPose compound = compounded(kFirst, kSecond);
  std::vector<Pose2> samples;
  for (int i = 0; i < 20'000; ++i) {
    samples.push_back(drawn(kFirst, &random) * drawn(kSecond, &random));
  }
  const Matrix3d expected = sampled_covariance(samples, compound.mean);
  EXPECT_LT((compound.covariance - expected).norm(), 0.05 * expected.norm());
}

TEST(GaussianPose, InvertsAsItsSamplesDo) {
  std::mt19937 random(2);
  const GaussianPose inverse = inverted(kSecond);
  std::vector<Pose2> samples;
  for (int i = 0; i < 20'000; ++i) {
    samples.push_back(drawn(kSecond, &random).inverse());
  }
  const Matrix3d expected = sampled_covariance(samples, inverse.mean);
  EXPECT_LT((inverse.covariance - expected).norm(), 0.05 * expected.norm());
}

TEST(GaussianPose, DistanceWrapsTheHeading) {
  const Matrix3d unit = Matrix3d::Identity();
  EXPECT_NEAR(squared_mahalanobis(Pose2(0, 0, 3.1), Pose2(0, 0, -3.1), unit), 0.0069, 1e-3);
}

TEST(GaussianPose, KnowsWhatIsNoCovariance) {
  EXPECT_TRUE(is_positive_definite(Matrix3d::Identity()));
  EXPECT_FALSE(is_positive_definite(Matrix3d::Zero()));
  Matrix3d negative = Matrix3d::Identity();
  negative(1, 1) = -1e-6;
  EXPECT_FALSE(is_positive_definite(negative));
  Matrix3d lopsided = Matrix3d::Identity();
  lopsided(0, 1) = 0.1;
  EXPECT_FALSE(is_positive_definite(lopsided));
}

}  // namespace
}  // namespace cairn
