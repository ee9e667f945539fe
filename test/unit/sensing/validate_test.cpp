#include <limits>

#include <gmock/gmock.h>

#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"

namespace cairn {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

LaserScan sound_scan() {
  LaserScan scan;
  scan.bearings_rad = {-1.0F, 0.0F, 1.0F};
  scan.ranges_m = {1.0F, kInfinity, kNaN};
  scan.max_range_m = 10.0;
  return scan;
}

TEST(LaserScan, MayHaveBeamsWithoutReturnAndWithoutMeaning) {
  EXPECT_TRUE(validate(sound_scan()).ok());
}

TEST(LaserScan, NeedsAsManyBearingsAsRanges) {
  LaserScan scan = sound_scan();
  scan.bearings_rad.pop_back();
  EXPECT_FALSE(validate(scan).ok());
}

TEST(LaserScan, HasTwoToTenThousandBeams) {
  LaserScan scan = sound_scan();
  scan.bearings_rad.resize(1);
  scan.ranges_m.resize(1);
  EXPECT_FALSE(validate(scan).ok());
  scan.bearings_rad.assign(10'001, 0.0F);
  scan.ranges_m.assign(10'001, 1.0F);
  EXPECT_FALSE(validate(scan).ok());
}

TEST(LaserScan, HasFiniteBearingsWithinATurn) {
  LaserScan scan = sound_scan();
  scan.bearings_rad[1] = kNaN;
  EXPECT_FALSE(validate(scan).ok());
  scan.bearings_rad = {-3.2F, 0.0F, 3.2F};
  EXPECT_FALSE(validate(scan).ok());
}

TEST(LaserScan, HasNoRangeAtOrBehindTheSensor) {
  LaserScan scan = sound_scan();
  scan.ranges_m[0] = 0.0F;
  EXPECT_FALSE(validate(scan).ok());
  scan.ranges_m[0] = -kInfinity;
  EXPECT_FALSE(validate(scan).ok());
}

TEST(LaserScan, HasAFiniteMaxRangeAndMounting) {
  LaserScan scan = sound_scan();
  for (const double max_range_m :
       {0.0, -1.0, static_cast<double>(kNaN), static_cast<double>(kInfinity)}) {
    scan.max_range_m = max_range_m;
    EXPECT_FALSE(validate(scan).ok()) << max_range_m;
  }
  scan = sound_scan();
  scan.T_robot_laser = Pose2(static_cast<double>(kNaN), 0.0, 0.0);
  EXPECT_FALSE(validate(scan).ok());
  scan = sound_scan();
  scan.sweep_duration_s = -0.1;
  EXPECT_FALSE(validate(scan).ok());
}

TEST(Odometry, IsFiniteAndNotAbsurdlyFar) {
  OdometrySample sample;
  EXPECT_TRUE(validate(sample).ok());
  sample.T_odom_robot = Pose2(1e7, 0.0, 0.0);
  EXPECT_FALSE(validate(sample).ok());
  sample.T_odom_robot = Pose2(0.0, static_cast<double>(kNaN), 0.0);
  EXPECT_FALSE(validate(sample).ok());
  sample.T_odom_robot = Pose2(0.0, 0.0, static_cast<double>(kInfinity));
  EXPECT_FALSE(validate(sample).ok());
}

}  // namespace
}  // namespace cairn
