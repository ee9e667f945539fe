// What the service makes of sensors that fail, stop or lie: it says why, and keeps its map.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "simulated_drive.hpp"

namespace cairn {
namespace {

using test::Readings;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using State = LocalisationState;

void without_odometry(Readings* readings) {
  readings->odometry.reset();
}
void without_scans(Readings* readings) {
  readings->scans.clear();
}
void with_ranges(float range_m, Readings* readings) {
  for (LaserScan& scan : readings->scans) {
    std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), range_m);
  }
}
void with_no_return(Readings* readings) {
  with_ranges(std::numeric_limits<float>::infinity(), readings);
}
void with_a_hand_before_it(Readings* readings) {
  with_ranges(0.05F, readings);
}
void with_a_bag_over_it(Readings* readings) {
  static constexpr std::array<float, 4> kNoise_m = {-0.01F, 0.0F, 0.005F, 0.01F};
  for (LaserScan& scan : readings->scans) {
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const auto moment = static_cast<std::size_t>(utime_of(scan.time) / 100'000);
      scan.ranges_m[i] = 0.3F + kNoise_m[(moment * 7 + i * 3 + i * moment) % kNoise_m.size()];
    }
  }
}

class BadInput : public testing::Test {
 protected:
  BadInput() { drive_.go(kBefore); }

  void expect_unharmed() {
    EXPECT_LT(drive_.error_m(), 0.1);
    EXPECT_LT(drive_.share_of_stray_walls(), 0.01);
    for (const PerceivedScan& scan : drive_.perceived()) {
      ASSERT_TRUE(is_positive_definite(scan.fix.motion.covariance));
    }
  }
  void expect_recovered() {
    drive_.go(30);
    EXPECT_EQ(drive_.health().state, State::kTracking)
        << reason_of(drive_.health(), LocalisationOptions());
    expect_unharmed();
  }

  static constexpr int kBefore = 60;
  test::SimulatedDrive drive_;
};

TEST_F(BadInput, GoodInputIsNotComplainedOf) {
  drive_.go(300);
  EXPECT_THAT(drive_.reasons(), testing::ElementsAre("tracking: "));
  EXPECT_EQ(drive_.health().times_lost, 0);
  expect_unharmed();
}

TEST_F(BadInput, ScansWithoutOdometryForMinutes) {
  drive_.go(1200, without_odometry);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("no odometry for")));
  EXPECT_FALSE(drive_.health().uses_odometry);
  EXPECT_GT(drive_.health().no_odometry_s, 119.0);
  expect_recovered();
  EXPECT_TRUE(drive_.health().uses_odometry);
}

TEST_F(BadInput, NoOdometryAtAll) {
  test::SimulatedDrive drive;
  drive.go(600, without_odometry);
  drive.finish();
  EXPECT_EQ(drive.health().state, State::kDegraded);
  EXPECT_THAT(drive.reasons(),
              Contains("degraded: no odometry: the robot is taken to go on as it went, "
                       "corrected by the scans"));
  EXPECT_LT(drive.error_m(), 0.2);
  EXPECT_LT(drive.share_of_stray_walls(), 0.02);
}

TEST_F(BadInput, OdometryWithoutScansForMinutes) {
  const auto cells = drive_.service().local_map().cells();
  drive_.go(1200, without_scans);
  EXPECT_EQ(drive_.health().state, State::kDegraded);
  EXPECT_THAT(reason_of(drive_.health(), LocalisationOptions()), HasSubstr("no scan for 120"));
  EXPECT_EQ(drive_.service().local_map().cells(), cells);
  expect_recovered();
}

TEST_F(BadInput, ScansOfNothingButNoReturn) {
  const auto cells = drive_.service().local_map().cells();
  drive_.go(300, with_no_return);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("is the laser covered")));
  EXPECT_EQ(drive_.service().local_map().cells(), cells);
  expect_recovered();
}

TEST_F(BadInput, ABlockedSensor) {
  const auto cells = drive_.service().local_map().cells();
  drive_.go(300, with_a_hand_before_it);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("is the laser covered")));
  EXPECT_EQ(drive_.service().local_map().cells(), cells);
  expect_recovered();
}

TEST_F(BadInput, ABagOverTheSensor) {
  const auto cells = drive_.service().local_map().cells();
  drive_.go(300, with_a_bag_over_it);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("is the laser covered")));
  EXPECT_EQ(drive_.service().local_map().cells(), cells);
  expect_recovered();
}

TEST_F(BadInput, NoMapIsDrawnFromScansOfABlockedSensor) {
  drive_.go(30, with_no_return);
  drive_.go(30);
  const std::vector<PosedScan> trajectory = drive_.service().state()->trajectory;
  int untrusted = 0;
  for (const PosedScan& posed : trajectory) {
    const bool is_blind = std::all_of(posed.scan->ranges_m.begin(), posed.scan->ranges_m.end(),
                                      [](float range_m) { return std::isinf(range_m); });
    EXPECT_EQ(posed.is_trusted, !is_blind);
    untrusted += posed.is_trusted ? 0 : 1;
  }
  EXPECT_EQ(untrusted, 30);
}

// The wheels go on in circles; whether the robot is still in this room, or in one that looks the
// same, nobody can say. What comes after is a map of its own, and the way to it is unsure.
TEST_F(BadInput, AfterALongBlindWayNothingIsMatchedWithWhatWasSeenBefore) {
  const std::size_t before = drive_.perceived().size();
  drive_.go(100, without_scans);
  drive_.go(1);
  EXPECT_TRUE(drive_.perceived()[before].fix.is_matched) << "a short way";
  const double short_way_m2 = drive_.perceived()[before].fix.motion.covariance(0, 0);
  const std::size_t later = drive_.perceived().size();
  drive_.go(1000, without_scans);
  drive_.go(1);
  const LocalFix& fix = drive_.perceived()[later].fix;
  EXPECT_FALSE(fix.is_matched);
  EXPECT_GT(fix.motion.covariance(0, 0), 100.0 * short_way_m2);
  expect_recovered();
}

TEST_F(BadInput, BlindForSoLongThatTheRobotIsLostAndFoundAgain) {
  const auto cells = drive_.service().local_map().cells();
  drive_.go(600, [](Readings* readings) {
    with_no_return(readings);
    without_odometry(readings);
  });
  EXPECT_EQ(drive_.health().state, State::kLost);
  EXPECT_GT(drive_.health().scans_not_mapped, 0);
  EXPECT_EQ(drive_.service().local_map().cells(), cells) << "no map while badly localised";
  EXPECT_EQ(drive_.health().times_lost, 1);
}

TEST(BadMounting, ALaserThatLooksBackwardIsSaidAndTheMapIsOneOfTheRoom) {
  test::SimulatedDrive drive;
  drive.mount_lasers({Pose2(0.0, 0.0, kPi)});
  drive.go(200, [](Readings* readings) { readings->scans.front().T_robot_laser = Pose2(); });
  EXPECT_THAT(drive.reasons(), Contains(HasSubstr("the laser looks backward: check the mounting")));
  EXPECT_EQ(drive.health().fault, MotionFault::kLaserReversed);
  EXPECT_EQ(drive.health().count(MotionFault::kLaserReversed), 1);
  EXPECT_LT(drive.share_of_stray_walls(Pose2(0.0, 0.0, kPi)), 0.02);
}

TEST(BadMounting, ALaserThatHangsUpsideDownIsSaidAndTheMapIsTheMirroredRoom) {
  test::SimulatedDrive drive;
  drive.go(300, [](Readings* readings) {
    std::vector<float>& bearings = readings->scans.front().bearings_rad;
    std::transform(bearings.begin(), bearings.end(), bearings.begin(), std::negate<>());
  });
  EXPECT_THAT(drive.reasons(), Contains(HasSubstr("it hangs upside down")));
  EXPECT_LT(drive.share_of_stray_walls(Pose2(), true), 0.02);
}

TEST_F(BadInput, BeamsAndFieldOfViewThatChange) {
  for (const auto& [beams, span_rad] :
       std::vector<std::pair<int, double>>{{361, kPi}, {90, 2.0}, {682, 4.19}, {30, 2.0 * kPi}}) {
    drive_.laser().set_beams(beams, span_rad);
    drive_.go(20);
    expect_unharmed();
  }
  EXPECT_EQ(drive_.health().times_lost, 0);
}

TEST_F(BadInput, StampsThatRepeat) {
  const TimePoint time = drive_.perceived().back().fix.time;
  drive_.go(20, [time](Readings* readings) {
    readings->odometry->time = time;
    readings->scans.front().time = time;
  });
  EXPECT_GT(drive_.service().joiner_counters().repeated, 0U);
  expect_recovered();
}

TEST_F(BadInput, StampsThatStepBack) {
  drive_.go(20, [](Readings* readings) {
    readings->odometry->time -= std::chrono::seconds(3);
    readings->scans.front().time -= std::chrono::seconds(3);
  });
  EXPECT_GT(drive_.service().joiner_counters().out_of_order, 0U);
  expect_recovered();
}

TEST_F(BadInput, StampsThatJumpByHoursAndBack) {
  drive_.go(30, [](Readings* readings) {
    readings->odometry->time += std::chrono::hours(5);
    readings->scans.front().time += std::chrono::hours(5);
  });
  EXPECT_EQ(drive_.service().joiner_counters().clock_steps, 1U);
  expect_recovered();
  EXPECT_EQ(drive_.service().joiner_counters().clock_steps, 2U);
  EXPECT_EQ(drive_.health().times_lost, 0);
  EXPECT_THAT(drive_.reasons(), Not(Contains(HasSubstr("no scan for"))));
}

TEST_F(BadInput, OdometryThatTeleports) {
  const Pose2 T_jump(400.0, -90.0, 2.0);
  drive_.go(30, [&T_jump](Readings* readings) {
    readings->odometry->T_odom_robot = T_jump * readings->odometry->T_odom_robot;
  });
  EXPECT_EQ(drive_.health().count(MotionFault::kTeleport), 1);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("teleport: odometry jumped")));
  expect_unharmed();
}

TEST_F(BadInput, OdometryThatStalls) {
  const Pose2 stuck = drive_.T_world_robot();
  drive_.go(40, [&stuck](Readings* readings) { readings->odometry->T_odom_robot = stuck; });
  EXPECT_EQ(drive_.health().count(MotionFault::kOdometryStalled), 1);
  expect_unharmed();
}

TEST_F(BadInput, WheelsThatSlip) {
  double slipped_m = 0.0;
  drive_.stand(40, [&](Readings* readings) {
    slipped_m += 0.08;
    readings->odometry->T_odom_robot = readings->odometry->T_odom_robot * Pose2(slipped_m, 0, 0);
  });
  EXPECT_GE(drive_.health().count(MotionFault::kSlip), 1);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("the wheels say more than the scans")));
  expect_unharmed();
}

TEST_F(BadInput, ALaserThatRepeatsItsLastScan) {
  const LaserScan last = *drive_.perceived().back().scan;
  drive_.go(20, [&last](Readings* readings) { readings->scans.front().ranges_m = last.ranges_m; });
  EXPECT_EQ(drive_.health().count(MotionFault::kScanStalled), 1);
  EXPECT_LT(drive_.share_of_stray_walls(), 0.02);
}

}  // namespace
}  // namespace cairn
