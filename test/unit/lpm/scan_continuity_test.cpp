#include "lpm/scan_continuity.hpp"

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;

ScanBeams beams_from(const Pose2& T_world_robot, SimulatedLaser* laser) {
  ScanBeams beams;
  beams.take(laser->scan(T_world_robot, 0.0), {}, 20.0);
  return beams;
}

std::vector<Vector2d> returns_from(const Pose2& T_world_robot, SimulatedLaser* laser) {
  std::vector<Vector2d> returns;
  const ScanBeams beams = beams_from(T_world_robot, laser);
  for (const SurfacePoint& point : beams.returns()) {
    returns.push_back(point.p);
  }
  return returns;
}

TEST(Continuity, IsNearlyWholeForARobotThatDroveEvenIfTheTurnIsNotWellKnown) {
  SimulatedLaser laser(furnished_room());
  const Pose2 before(0.0, -1.0, 0.3);
  for (const double misjudged_rad : {-0.2, 0.0, 0.2}) {
    const Pose2 step(0.15, 0.0, 0.1);
    const ScanBeams now = beams_from(before * step, &laser);
    const Pose2 believed(0.15, 0.0, 0.1 + misjudged_rad);
    EXPECT_GT(continuity(now, returns_from(before, &laser), believed), 0.85) << misjudged_rad;
  }
}

TEST(Continuity, IsLowForARobotThatWasCarried) {
  SimulatedLaser laser(furnished_room());
  const std::vector<Vector2d> before = returns_from(Pose2(0.0, -1.0, 0.3), &laser);
  EXPECT_LT(continuity(beams_from(Pose2(-3.0, 1.0, 2.5), &laser), before, Pose2()), 0.65);
  EXPECT_LT(continuity(beams_from(Pose2(3.5, -2.0, -2.0), &laser), before, Pose2()), 0.65);
}

TEST(Continuity, IsNoneWithoutReturns) {
  SimulatedLaser laser(furnished_room());
  EXPECT_EQ(continuity(ScanBeams(), returns_from(Pose2(), &laser), Pose2()), 0.0);
  EXPECT_EQ(continuity(beams_from(Pose2(), &laser), {}, Pose2()), 0.0);
}

/// A mapper that is content with no match: what it makes of contradictions that go on.
LocalMapper discontented() {
  LpmOptions options;
  options.match.min_explained_share = 1.0;
  return LocalMapper(options);
}

Pose2 on_the_way(int step) {
  return {-2.0 + 0.1 * step, -0.5, 0.02 * step};
}

/// A scan among legs that no map knows: some beams are cut short, at random.
LaserScan scan_among_legs(int step, SimulatedLaser* laser) {
  LaserScan scan = laser->scan(on_the_way(step), 0.1 * step);
  for (std::size_t i = static_cast<std::size_t>(step) % 7; i < scan.ranges_m.size(); i += 7) {
    scan.ranges_m[i] *= 0.5F + 0.05F * static_cast<float>((step + 3 * static_cast<int>(i)) % 8);
  }
  return scan;
}

TEST(Contradiction, WithSoundOdometryRenewsTheMapAndKeepsTheWay) {
  LocalMapper mapper = discontented();
  SimulatedLaser laser(furnished_room());
  double sigma_m = 0.0;
  for (int i = 0; i < 40; ++i) {
    const LocalFix fix = mapper.absorb({scan_among_legs(i, &laser), on_the_way(i)});
    sigma_m = std::max(sigma_m, std::sqrt(fix.covariance(0, 0)));
    const Pose2 truth = on_the_way(0).inverse() * on_the_way(i);
    EXPECT_LT((fix.T_lpm_robot.translation() - truth.translation()).norm(), 0.2) << i;
  }
  EXPECT_GE(mapper.renewals(), 2);
  EXPECT_EQ(mapper.restarts(), 0);
  EXPECT_LT(sigma_m, 1.0);
}

TEST(Contradiction, WithoutOdometryMakesTheWayUnknown) {
  LocalMapper mapper = discontented();
  SimulatedLaser laser(furnished_room());
  for (int i = 0; i < 40; ++i) {
    mapper.absorb({scan_among_legs(i, &laser), std::nullopt});
  }
  EXPECT_EQ(mapper.renewals(), 0);
  EXPECT_GE(mapper.restarts(), 2);
}

}  // namespace
}  // namespace cairn
