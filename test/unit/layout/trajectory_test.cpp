#include "layout/trajectory.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace cairn {
namespace {

void expect_near(const Pose2& a, const Pose2& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
  EXPECT_NEAR(turn_between(a.theta(), b.theta()), 0.0, tolerance);
}

std::vector<Pose2> wandering(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Pose2> path{Pose2(uniform(random), uniform(random), uniform(random))};
  for (int i = 1; i < count; ++i) {
    path.push_back(path.back() * Pose2(0.3 * uniform(random), 0.0, 0.4 * uniform(random) - 0.2));
  }
  return path;
}

std::vector<Pose2> straight(int count, double step_m) {
  std::vector<Pose2> path;
  for (int i = 0; i < count; ++i) {
    path.emplace_back(step_m * i, 0.0, 0.0);
  }
  return path;
}

TEST(Trajectory, IsTheLocalPathMovedRigidlyWhereBothEndsAgree) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Pose2> path = wandering(seed, 60);
    const Pose2 T_global_lpm(3.0, -2.0, 2.5);
    const std::vector<Pose2> poses =
        interpolate_travel(path, T_global_lpm * path.front(), T_global_lpm * path.back());
    ASSERT_EQ(poses.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
      expect_near(poses[i], T_global_lpm * path[i]);
    }
  }
}

TEST(Trajectory, StartsAndEndsWhereItIsTold) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Pose2> path = wandering(seed, 40);
    const Pose2 first(1.0, 2.0, 3.0);
    const Pose2 last(-4.0, 5.0, -1.0);
    const std::vector<Pose2> poses = interpolate_travel(path, first, last);
    expect_near(poses.front(), first);
    expect_near(poses.back(), last);
  }
}

// A corridor bent by a heading error of 0.2 rad over 20 m: every step keeps its length and the
// robot keeps looking along its way.
TEST(Trajectory, BendsAndIsNotShearedByACorrectionOfHeading) {
  const std::vector<Pose2> path = straight(201, 0.1);
  const double radius_m = 20.0 / 0.2;
  const Pose2 last(radius_m * std::sin(0.2), radius_m * (1.0 - std::cos(0.2)), 0.2);
  const std::vector<Pose2> poses = interpolate_travel(path, Pose2(), last);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double dx = poses[i].x() - poses[i - 1].x();
    const double dy = poses[i].y() - poses[i - 1].y();
    EXPECT_NEAR(std::hypot(dx, dy), 0.1, 1e-5);
    EXPECT_NEAR(std::atan2(dy, dx), 0.5 * (poses[i].theta() + poses[i - 1].theta()), 1e-4);
  }
}

TEST(Trajectory, SpreadsATranslationByTheDistanceDriven) {
  const std::vector<Pose2> path{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {4.0, 0.0, 0.0}};
  const std::vector<Pose2> poses = interpolate_travel(path, Pose2(), {4.0, 0.8, 0.0});
  expect_near(poses[1], {1.0, 0.2, 0.0});
  expect_near(poses[2], {1.0, 0.2, 0.0});
}

TEST(Trajectory, CorrectsTheShortWayRound) {
  std::vector<Pose2> path = straight(11, 1.0);
  const std::vector<Pose2> poses = interpolate_travel(path, {0.0, 0.0, 3.1}, {-10.0, 0.0, -3.1});
  for (const Pose2& pose : poses) {
    EXPECT_GT(std::abs(pose.theta()), 3.0);
  }
}

TEST(Trajectory, OfARobotThatNeverMovedGoesByTheNumberOfThePose) {
  const std::vector<Pose2> path(5, Pose2(1.0, 1.0, 1.0));
  const std::vector<Pose2> poses = interpolate_travel(path, Pose2(), {4.0, 0.0, 0.4});
  expect_near(poses[2], {2.0, 0.0, 0.2});
}

TEST(Trajectory, OfNoneOrOnePoseIsNoneOrTheFirst) {
  EXPECT_TRUE(interpolate_travel({}, Pose2(), Pose2()).empty());
  const std::vector<Pose2> one = interpolate_travel({Pose2()}, {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0});
  ASSERT_EQ(one.size(), 1U);
  expect_near(one.front(), {1.0, 2.0, 3.0});
}

TEST(Trajectory, IsMostUncertainMidwayAndAsSureAsItsPlacesAtTheEnds) {
  const std::vector<Pose2> path = straight(101, 0.1);
  const Matrix3d sure = 1e-4 * Matrix3d::Identity();
  const Matrix3d less_sure = 4e-4 * Matrix3d::Identity();
  const std::vector<GaussianPose> poses =
      interpolate_uncertain_travel(path, {path.front(), sure}, {path.back(), less_sure});
  EXPECT_LT((poses.front().covariance - sure).norm(), 1e-9);
  EXPECT_LT((poses.back().covariance - less_sure).norm(), 1e-9);
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    EXPECT_TRUE(is_positive_definite(poses[i].covariance));
    EXPECT_LE(poses[i].covariance.trace(), poses[50].covariance.trace() + less_sure.trace());
  }
  EXPECT_GT(poses[50].covariance.trace(), 5.0 * less_sure.trace());
}

TEST(Trajectory, OfARobotThatNeverMovedIsAsSureAsItsEnds) {
  const Matrix3d sure = 1e-4 * Matrix3d::Identity();
  const std::vector<Pose2> path(3, Pose2());
  for (const GaussianPose& pose :
       interpolate_uncertain_travel(path, {Pose2(), sure}, {Pose2(), sure})) {
    EXPECT_LT((pose.covariance - sure).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace cairn
