#include "lpm/scan_matcher.hpp"

#include <random>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;

ScrollingMap map_of_the_room() {
  ScrollingMap map(ScrollingMapOptions{});
  SimulatedLaser laser(furnished_room(), 7);
  for (int i = 0; i < 40; ++i) {
    const Pose2 at(0.04 * i - 0.8, 0.02 * i - 0.4, 0.16 * i);
    map.insert(laser.scan(at, 0.0), at, 0.0);
  }
  return map;
}

Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

ScanMatch match_at(const ScrollingMap& map,
                   SimulatedLaser* laser,
                   const Pose2& at,
                   const GaussianPose& predicted) {
  ScanMatcher matcher(ScanMatchOptions{});
  ScanBeams beams;
  beams.take(laser->scan(at, 0.0), {}, 20.0);
  matcher.take(beams);
  return matcher.match(map, predicted);
}

TEST(ScanMatcher, IsAboutAsWrongAsItSays) {
  const ScrollingMap map = map_of_the_room();
  SimulatedLaser laser(furnished_room(), 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  constexpr int kSamples = 150;
  double squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const Pose2 at(0.8 * off(random), 0.4 * off(random), kPi * off(random));
    const Pose2 guess(at.x() + 0.05 * off(random), at.y() + 0.05 * off(random),
                      at.theta() + 0.03 * off(random));
    const ScanMatch match = match_at(map, &laser, at, {guess, diagonal(0.3, 0.2)});
    squares += squared_mahalanobis(match.fit.T_lpm_robot, at,
                                   match.covariance(ScanMatchOptions{}.hit_sigma_m));
  }
  const double mean = squares / kSamples;  // 3 on average where covariances are right
  RecordProperty("mean_squared_mahalanobis", std::to_string(mean));
  EXPECT_GT(mean, 1.0);
  EXPECT_LT(mean, 6.0);
}

TEST(ScanMatcher, NeedsNoSearchWhereOdometryIsGood) {
  const ScrollingMap map = map_of_the_room();
  SimulatedLaser laser(furnished_room(), 3);
  const Pose2 at(0.3, 0.1, 0.4);
  const ScanMatch match = match_at(map, &laser, at, {Pose2(0.33, 0.08, 0.42), diagonal(0.1, 0.05)});
  EXPECT_FALSE(match.was_searched);
  EXPECT_LT((match.fit.T_lpm_robot.translation() - at.translation()).norm(), 0.02);
  EXPECT_GT(match.score, 0.9);
}

TEST(ScanMatcher, FindsARobotThatWasTurnedByHand) {
  const ScrollingMap map = map_of_the_room();
  SimulatedLaser laser(furnished_room(), 3);
  for (const double turn_rad : {-2.5, -1.4, 1.4, 2.5}) {
    SCOPED_TRACE(turn_rad);
    const Pose2 before(0.2, 0.1, 0.3);
    const Pose2 at(0.2, 0.1, 0.3 + turn_rad);
    const ScanMatch match = match_at(map, &laser, at, {before, diagonal(0.1, 0.02)});
    EXPECT_TRUE(match.was_searched);
    EXPECT_NEAR(turn_between(match.fit.T_lpm_robot.theta(), at.theta()), 0.0, 0.02);
    EXPECT_LT((match.fit.T_lpm_robot.translation() - at.translation()).norm(), 0.03);
  }
}

TEST(ScanMatcher, DoesNotTurnRoundInACorridor) {
  ScrollingMap map(ScrollingMapOptions{});
  SimulatedLaser laser(test::endless_corridor(), 7);
  for (int i = 0; i < 10; ++i) {
    map.insert(laser.scan(Pose2(0.1 * i, 0.0, 0.0), 0.0), Pose2(0.1 * i, 0.0, 0.0), 0.0);
  }
  const Pose2 at(1.0, 0.0, 0.0);
  const ScanMatch match = match_at(map, &laser, at, {at, diagonal(0.1, 0.05)});
  EXPECT_NEAR(match.fit.T_lpm_robot.theta(), 0.0, 0.02);
}

}  // namespace
}  // namespace cairn
