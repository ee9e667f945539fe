#include "service/between_scans.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

OdometrySample at(int utime, double x_m) {
  return {time_of_utime(utime), Pose2(x_m, 0.0, 0.0)};
}

TEST(BetweenScans, GivesPosesInTheFrameOfTheRobotAtTheScanBefore) {
  BetweenScans between;
  between.add(at(100, 1.0));
  EXPECT_THAT(between.take(time_of_utime(100), Pose2(1.0, 0.0, 0.0)), IsEmpty());
  between.add(at(150, 1.5));
  between.add(at(200, 2.0));
  const std::vector<OdometrySample> taken = between.take(time_of_utime(200), Pose2(2.0, 0.0, 0.0));
  ASSERT_THAT(taken, SizeIs(2));
  EXPECT_EQ(taken[0].time, time_of_utime(150));
  EXPECT_DOUBLE_EQ(taken[0].T_odom_robot.x(), 0.5);
  EXPECT_EQ(taken[1].time, time_of_utime(200));
  EXPECT_DOUBLE_EQ(taken[1].T_odom_robot.x(), 1.0);
}

TEST(BetweenScans, KeepsTheOrderOfArrivalWhereStampsStepBack) {
  BetweenScans between;
  between.add(at(1000, 1.0));
  static_cast<void>(between.take(time_of_utime(1000), Pose2(1.0, 0.0, 0.0)));
  between.add(at(1500, 1.2));
  between.add(at(900, 1.4));
  between.add(at(950, 1.6));  // The scan's own.
  between.add(at(1600, 1.8));
  const std::vector<OdometrySample> taken = between.take(time_of_utime(950), Pose2(1.6, 0.0, 0.0));
  ASSERT_THAT(taken, SizeIs(3));
  EXPECT_EQ(taken[1].time, time_of_utime(900));
  EXPECT_EQ(taken[2].time, time_of_utime(950));
}

TEST(BetweenScans, AScanWithoutOdometryBreaksTheChain) {
  BetweenScans between;
  between.add(at(100, 1.0));
  static_cast<void>(between.take(time_of_utime(100), Pose2(1.0, 0.0, 0.0)));
  between.add(at(150, 1.5));
  EXPECT_THAT(between.take(time_of_utime(200), std::nullopt), IsEmpty());
  between.add(at(300, 3.0));
  EXPECT_THAT(between.take(time_of_utime(300), Pose2(3.0, 0.0, 0.0)), IsEmpty());
}

TEST(BetweenScans, IsBounded) {
  BetweenScans between;
  between.add(at(0, 0.0));
  static_cast<void>(between.take(time_of_utime(0), Pose2()));
  for (int i = 1; i <= 5000; ++i) {
    between.add(at(i, 0.001 * i));
  }
  EXPECT_THAT(between.take(time_of_utime(5000), Pose2(5.0, 0.0, 0.0)), SizeIs(BetweenScans::kMost));
}

}  // namespace
}  // namespace cairn
