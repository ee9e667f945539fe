#include "lpm/scan_lag.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace cairn {
namespace {

TimePoint at(double seconds) {
  return time_of_utime(static_cast<std::int64_t>(std::llround(seconds * 1e6)));
}

/// A robot that turns to and fro while it drives.
Pose2 T_odom_robot(double time_s) {
  return {0.3 * time_s, 0.0, 0.8 * std::sin(3.0 * time_s)};
}

/// Scans ten times a second that were taken so much before their stamps.
void drive(double late_s, int scans, ScanLag* lag) {
  for (int i = 0; i < scans; ++i) {
    const double time_s = 0.1 * i;
    lag->add(at(time_s), T_odom_robot(time_s));
    lag->learn(turn_between(T_odom_robot(time_s - 0.1 - late_s).theta(),
                            T_odom_robot(time_s - late_s).theta()));
  }
}

TEST(ScanLag, StaysNoneWhereScansAndOdometryGoTogether) {
  ScanLag lag;
  drive(0.0, 300, &lag);
  EXPECT_EQ(lag.lag_s(), 0.0);
  const Pose2 step = T_odom_robot(29.8).inverse() * T_odom_robot(29.9);
  EXPECT_NEAR(lag.step()->theta(), step.theta(), 1e-12);
}

TEST(ScanLag, IsFoundFromTurnsAndTakenOff) {
  for (const double late_s : {0.06, 0.1, 0.16, 0.24}) {
    ScanLag lag;
    drive(late_s, 100, &lag);
    EXPECT_NEAR(lag.lag_s(), late_s, 0.021);
    const double turn_rad =
        turn_between(T_odom_robot(9.8 - late_s).theta(), T_odom_robot(9.9 - late_s).theta());
    EXPECT_NEAR(lag.step()->theta(), turn_rad, 0.04) << late_s;
  }
}

TEST(ScanLag, IsNotSoughtInNoise) {
  ScanLag lag;
  for (int i = 0; i < 500; ++i) {
    lag.add(at(0.1 * i), Pose2());
    lag.learn(0.002 * std::sin(7.0 * i));
  }
  EXPECT_EQ(lag.lag_s(), 0.0);
}

TEST(ScanLag, IsNotProvedByOneSlip) {
  ScanLag lag;
  for (int i = 0; i < 30; ++i) {
    lag.add(at(0.1 * i), Pose2(0.0, 0.0, i < 20 ? 0.0 : 0.3));
    lag.learn(i == 21 ? 0.3 : 0.0);  // the wheels spun, and the robot was pushed afterwards
  }
  EXPECT_EQ(lag.lag_s(), 0.0);
}

TEST(ScanLag, IsGivenUpWhenItIsNoMore) {
  ScanLag lag;
  drive(0.16, 100, &lag);
  ASSERT_GT(lag.lag_s(), 0.1);
  drive(0.0, 1000, &lag);
  EXPECT_EQ(lag.lag_s(), 0.0);
}

TEST(ScanLag, ForgetsThePastWhereStampsStepBack) {
  ScanLag lag;
  lag.add(at(10.0), Pose2());
  lag.add(at(10.1), Pose2(1.0, 0.0, 0.0));
  EXPECT_EQ(lag.step()->x(), 1.0);
  lag.add(at(9.0), Pose2(2.0, 0.0, 0.0));
  EXPECT_FALSE(lag.step().has_value());
}

}  // namespace
}  // namespace cairn
