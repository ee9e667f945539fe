#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "lpm/matcher.hpp"
#include "lpm/particle_matcher.hpp"
#include "lpm/scan_matcher.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::endless_corridor;
using test::furnished_room;
using test::SimulatedLaser;

ScanBeams beams_of(const LaserScan& scan) {
  ScanBeams beams;
  beams.take(scan, {}, 20.0);
  return beams;
}

/// What every way to match scans must fulfil.
template <typename Matcher>
class AnyMatcher : public testing::Test {
 protected:
  static ScrollingMap map_of(const std::vector<test::Wall>& walls, double from_m, double to_m) {
    ScrollingMap map{ScrollingMapOptions{}};
    SimulatedLaser laser(walls, 99);
    constexpr double kStep_m = 0.4;
    for (double x = from_m; x <= to_m; x += kStep_m) {
      for (int i = 0; i < 4; ++i) {  // all around
        const Pose2 pose(x, 0.0, 0.5 * kPi * i);
        map.insert(laser.scan(pose, 0.1), pose, 0.0);
      }
    }
    return map;
  }
  static ScrollingMap map_of_room() { return map_of(furnished_room(), -0.4, 0.5); }
  static GaussianPose unsure_about(const Pose2& pose, double sigma_m, double sigma_rad) {
    GaussianPose predicted{pose, Matrix3d::Zero()};
    predicted.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
    return predicted;
  }
  static double miss_m(const ScanMatch& match, const Pose2& truth) {
    return (match.fit.T_lpm_robot.translation() - truth.translation()).norm();
  }
  static double miss_rad(const ScanMatch& match, const Pose2& truth) {
    return std::abs(turn_between(match.fit.T_lpm_robot.theta(), truth.theta()));
  }

  Matcher matcher_{ScanMatchOptions{}};
};

using Matchers = testing::Types<ScanMatcher, ParticleMatcher>;
TYPED_TEST_SUITE(AnyMatcher, Matchers);

TYPED_TEST(AnyMatcher, FindsTheRobotNearItsPrediction) {
  const ScrollingMap map = this->map_of_room();
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    SimulatedLaser laser(furnished_room(), seed);
    const Pose2 truth(0.5 + 0.1 * std::sin(seed), -0.5 + 0.1 * std::cos(seed), 0.3 * seed);
    this->matcher_.take(beams_of(laser.scan(truth, 10.0 + seed)));
    ASSERT_FALSE(this->matcher_.is_blocked());
    const Pose2 guess(truth.x() + 0.1, truth.y() - 0.08, truth.theta() + 0.06);
    const ScanMatch match = this->matcher_.match(map, this->unsure_about(guess, 0.15, 0.08));
    EXPECT_LT(this->miss_m(match, truth), 0.04);
    EXPECT_LT(this->miss_rad(match, truth), 0.03);
    EXPECT_GT(match.score, 0.9);
    EXPECT_GT(match.known_share, 0.9);
  }
}

TYPED_TEST(AnyMatcher, FindsTheRobotAfterASlip) {
  const ScrollingMap map = this->map_of_room();
  SimulatedLaser laser(furnished_room(), 5);
  const Pose2 truth(0.1, 0.1, 0.2);
  this->matcher_.take(beams_of(laser.scan(truth, 10.0)));
  const ScanMatch match =
      this->matcher_.match(map, this->unsure_about(Pose2(0.45, -0.2, 0.35), 0.1, 0.06));
  EXPECT_LT(this->miss_m(match, truth), 0.05);
  EXPECT_LT(this->miss_rad(match, truth), 0.03);
}

TYPED_TEST(AnyMatcher, KnowsHowWellItKnowsInARoom) {
  const ScrollingMap map = this->map_of_room();
  SimulatedLaser laser(furnished_room(), 6);
  this->matcher_.take(beams_of(laser.scan(Pose2(), 10.0)));
  const ScanMatch match = this->matcher_.match(map, this->unsure_about(Pose2(), 0.1, 0.06));
  const Matrix3d covariance = match.fit.information.inverse();
  EXPECT_LT(covariance(0, 0), 0.03 * 0.03);
  EXPECT_LT(covariance(1, 1), 0.03 * 0.03);
  EXPECT_LT(covariance(2, 2), 0.02 * 0.02);
}

TYPED_TEST(AnyMatcher, KnowsNothingAlongACorridorAndLeavesThePredictionThere) {
  const ScrollingMap map = this->map_of(endless_corridor(), -12.0, 12.0);
  SimulatedLaser laser(endless_corridor(), 7);
  this->matcher_.take(beams_of(laser.scan(Pose2(0.0, 0.1, 0.0), 10.0)));
  const ScanMatch match =
      this->matcher_.match(map, this->unsure_about(Pose2(0.2, 0.0, 0.05), 0.15, 0.08));
  EXPECT_NEAR(match.fit.T_lpm_robot.x(), 0.2, 0.05);
  EXPECT_NEAR(match.fit.T_lpm_robot.y(), 0.1, 0.03);
  EXPECT_LT(match.fit.information(0, 0), 0.02 * match.fit.information(1, 1));
  EXPECT_GT(match.fit.information(1, 1), 1.0 / (0.03 * 0.03));
}

TYPED_TEST(AnyMatcher, ScoresAScanOfAnotherRoomPoorly) {
  const ScrollingMap map = this->map_of_room();
  std::vector<test::Wall> other;
  test::add_box({-2.5, -1.5}, {1.7, 2.9}, &other);
  SimulatedLaser laser(other, 8);
  this->matcher_.take(beams_of(laser.scan(Pose2(), 10.0)));
  const ScanMatch match = this->matcher_.match(map, this->unsure_about(Pose2(), 0.1, 0.06));
  EXPECT_LT(match.score, 0.6);
}

TYPED_TEST(AnyMatcher, HoldsAgainstPeopleInTheWay) {
  const ScrollingMap map = this->map_of_room();
  std::vector<test::Wall> crowded = furnished_room();
  test::add_box({1.2, -0.8}, {1.5, -0.5}, &crowded);
  test::add_box({1.0, 0.7}, {1.3, 1.0}, &crowded);
  SimulatedLaser laser(crowded, 9);
  const Pose2 truth(0.1, -0.05, 0.1);
  this->matcher_.take(beams_of(laser.scan(truth, 10.0)));
  const ScanMatch match =
      this->matcher_.match(map, this->unsure_about(Pose2(0.2, 0.0, 0.05), 0.15, 0.08));
  EXPECT_LT(this->miss_m(match, truth), 0.05);
  EXPECT_LT(this->miss_rad(match, truth), 0.03);
}

TYPED_TEST(AnyMatcher, IsBlockedWithoutReturns) {
  LaserScan scan = SimulatedLaser({}, 1).scan(Pose2(), 1.0);
  this->matcher_.take(beams_of(scan));
  EXPECT_TRUE(this->matcher_.is_blocked());
}

TYPED_TEST(AnyMatcher, GivesTheSameForTheSameScans) {
  const ScrollingMap map = this->map_of_room();
  TypeParam other{ScanMatchOptions{}};
  for (int i = 0; i < 5; ++i) {
    const LaserScan scan = SimulatedLaser(furnished_room(), 4).scan(Pose2(0.05 * i, 0.0, 0.0), i);
    this->matcher_.take(beams_of(scan));
    other.take(beams_of(scan));
    const GaussianPose predicted = this->unsure_about(Pose2(0.05 * i, 0.02, 0.03), 0.1, 0.05);
    const ScanMatch a = this->matcher_.match(map, predicted);
    const ScanMatch b = other.match(map, predicted);
    EXPECT_EQ(a.fit.T_lpm_robot, b.fit.T_lpm_robot);
    EXPECT_EQ(a.fit.information, b.fit.information);
  }
}

class ParticleMatcherTest : public AnyMatcher<ParticleMatcher> {};

TEST_F(ParticleMatcherTest, DrawsAsManyParticlesAsTheUncertaintyTakes) {
  const ScrollingMap map = map_of_room();
  matcher_.take(beams_of(SimulatedLaser(furnished_room(), 4).scan(Pose2(), 1.0)));
  (void)matcher_.match(map, unsure_about(Pose2(), 0.01, 0.005));
  const int sure = matcher_.particle_count();
  (void)matcher_.match(map, unsure_about(Pose2(), 0.2, 0.1));
  EXPECT_GT(matcher_.particle_count(), 3 * sure);
}

TEST_F(ParticleMatcherTest, HasNoBiasOverSeeds) {
  const ScrollingMap map = map_of_room();
  const Pose2 truth(0.1, 0.05, 0.1);
  const LaserScan scan = SimulatedLaser(furnished_room(), 4).scan(truth, 1.0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr int kSeeds = 20;
  for (int seed = 0; seed < kSeeds; ++seed) {
    ParticleOptions options;
    options.seed = seed;
    ParticleMatcher matcher(ScanMatchOptions{}, options);
    matcher.take(beams_of(scan));
    const Pose2 found = matcher.match(map, unsure_about(Pose2(), 0.1, 0.06)).fit.T_lpm_robot;
    const Eigen::Vector3d miss(found.x() - truth.x(), found.y() - truth.y(),
                               found.theta() - truth.theta());
    sum += miss;
    squares += miss.cwiseAbs2();
  }
  EXPECT_LT((sum / kSeeds).head<2>().norm(), 0.02);
  EXPECT_LT(std::sqrt(squares.x() / kSeeds), 0.02);
  EXPECT_LT(std::sqrt(squares.y() / kSeeds), 0.02);
}

TEST(Matcher, IsTheOneThatWasChosen) {
  EXPECT_EQ(matcher_kind_of("particles"), MatcherKind::kParticles);
  EXPECT_EQ(matcher_kind_of("correlative"), MatcherKind::kCorrelative);
  EXPECT_EQ(matcher_kind_of("magic"), std::nullopt);
  ScrollingMap map{ScrollingMapOptions{}};
  SimulatedLaser laser(furnished_room(), 4);
  map.insert(laser.scan(Pose2(), 0.0), Pose2(), 0.0);
  const LaserScan scan = laser.scan(Pose2(0.05, 0.0, 0.0), 1.0);
  GaussianPose predicted;
  predicted.covariance.diagonal() << 0.01, 0.01, 0.0025;
  ScanMatcher correlative{ScanMatchOptions{}};
  ParticleMatcher particles{ScanMatchOptions{}};
  Matcher chosen(MatcherKind::kCorrelative, {}, {});
  Matcher other(MatcherKind::kParticles, {}, {});
  correlative.take(beams_of(scan));
  particles.take(beams_of(scan));
  chosen.take(beams_of(scan));
  other.take(beams_of(scan));
  EXPECT_FALSE(chosen.is_blocked());
  EXPECT_EQ(chosen.match(map, predicted).fit.T_lpm_robot,
            correlative.match(map, predicted).fit.T_lpm_robot);
  EXPECT_EQ(other.match(map, predicted).fit.T_lpm_robot,
            particles.match(map, predicted).fit.T_lpm_robot);
}

TEST(SplitRandom, StreamsDoNotDependOnWhatWasDrawn) {
  SplitRandom random(42);
  SplitRandom before = random.split(3);
  for (int i = 0; i < 100; ++i) {
    (void)random.bits();
  }
  SplitRandom after = random.split(3);
  EXPECT_EQ(before.bits(), after.bits());
  EXPECT_NE(random.split(4).bits(), random.split(5).bits());
}

TEST(SplitRandom, IsUniformAndNormal) {
  SplitRandom random(1);
  double sum = 0.0;
  double normal_sum = 0.0;
  double normal_squares = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double uniform = random.uniform();
    ASSERT_GE(uniform, 0.0);
    ASSERT_LT(uniform, 1.0);
    sum += uniform;
    const double normal = random.normal();
    normal_sum += normal;
    normal_squares += normal * normal;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.005);
  EXPECT_NEAR(normal_sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(normal_squares / kCount, 1.0, 0.02);
}

}  // namespace
}  // namespace cairn
