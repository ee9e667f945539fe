#include "lpm/scan_beams.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kNoStatement = std::numeric_limits<float>::quiet_NaN();

LaserScan scan_of(const std::vector<float>& ranges_m) {
  LaserScan scan;
  scan.ranges_m = ranges_m;
  scan.max_range_m = 10.0;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    scan.bearings_rad.push_back(0.1F * static_cast<float>(i));
  }
  return scan;
}

TEST(ScanBeams, GiveReadingsTheirMeaning) {
  ScanBeams beams;
  beams.take(scan_of({2.0F, kNoStatement, kNone, 10.5F}), {}, 6.0);
  ASSERT_EQ(beams.returns().size(), 1U);
  EXPECT_NEAR(beams.returns()[0].p.x(), 2.0, 1e-6);
  ASSERT_EQ(beams.free_beams().size(), 2U) << "no return, and beyond the range limit";
  EXPECT_NEAR(beams.free_beams()[0].to.norm(), 6.0, 1e-6);
  EXPECT_EQ(beams.numbers()[0], 0U);
}

TEST(ScanBeams, StartAtTheLaser) {
  LaserScan scan = scan_of({2.0F, 2.0F});
  scan.T_robot_laser = Pose2(0.25, 0.1, kPi / 2.0);
  ScanBeams beams;
  beams.take(scan, {}, 6.0);
  EXPECT_NEAR((beams.origins()[0] - Vector2d(0.25, 0.1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((beams.returns()[0].p - Vector2d(0.25, 2.1)).norm(), 0.0, 1e-6);
}

TEST(ScanBeams, NormalsPointFromWallsToTheLaser) {
  test::SimulatedLaser laser({{{3.0, -4.0}, {3.0, 4.0}}});
  ScanBeams beams;
  beams.take(laser.scan(Pose2(), 0.0), {}, 6.0);
  ASSERT_GT(beams.returns().size(), 50U);
  for (const SurfacePoint& point : beams.returns()) {
    if (std::abs(point.p.y()) < 2.0) {
      EXPECT_LT(point.normal.x(), -0.95);
    }
  }
}

TEST(ScanBeams, OfAMovingRobotLieWhereTheyWould) {
  const std::vector<test::Wall> room = test::furnished_room();
  const Twist twist{0.8, 0.0, 1.2};
  LaserScan scan;
  scan.max_range_m = 20.0;
  scan.sweep_duration_s = 0.2;
  constexpr int kBeams = 181;
  for (int i = 0; i < kBeams; ++i) {
    const double t_s = scan.sweep_duration_s * i / (kBeams - 1);
    const Pose2 at(twist.ahead_m_per_s * t_s, 0.0, twist.turn_rad_per_s * t_s);
    const double bearing_rad = kPi * (static_cast<double>(i) / (kBeams - 1) - 0.5);
    scan.bearings_rad.push_back(static_cast<float>(bearing_rad));
    scan.ranges_m.push_back(
        static_cast<float>(test::range_to(room, at.translation(), at.theta() + bearing_rad)));
  }
  ScanBeams beams;
  beams.take(scan, twist, 6.0);
  for (const SurfacePoint& point : beams.returns()) {
    const double range_m =
        test::range_to(room, Vector2d::Zero(), std::atan2(point.p.y(), point.p.x()));
    EXPECT_TRUE(std::abs(range_m - point.p.norm()) < 0.01 || range_m < point.p.norm())
        << "on a wall, or behind a corner that hides it from the start";
  }
}

}  // namespace
}  // namespace cairn
