// What the local layer makes of sensors that fail, stop, or lie: a reason, and an unharmed map.

#include <algorithm>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;

Pose2 on_a_circle(int step) {
  const double angle = 0.05 * step;
  return {1.5 * std::cos(angle), 1.5 * std::sin(angle), angle + kPi / 2.0};
}

double distance_m(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

/// A mapper that has gone a little way in the room.
class LocalMapperFaults : public testing::Test {
 protected:
  LocalMapperFaults() {
    for (int i = 0; i <= kStart; ++i) {
      go_on(i, on_a_circle(i), 0.2 * i);
    }
  }
  LocalFix go_on(int step, const std::optional<Pose2>& odometry, double time_s) {
    return mapper_.absorb({laser_.scan(on_a_circle(step), time_s), odometry});
  }
  /// How far off it is, if it is at that step.
  [[nodiscard]] static double error_m(const LocalFix& fix, int step) {
    return distance_m(fix.T_lpm_robot, on_a_circle(0).inverse() * on_a_circle(step));
  }

  static constexpr int kStart = 30;
  LocalMapper mapper_;
  SimulatedLaser laser_{furnished_room()};
};

TEST_F(LocalMapperFaults, ScansWithoutOdometryForMinutesKeepTheTrack) {
  LocalFix fix;
  for (int i = 1; i <= 900; ++i) {
    fix = go_on(kStart + i, std::nullopt, 0.2 * (kStart + i));
    ASSERT_TRUE(fix.is_matched) << i;
  }
  EXPECT_LT(error_m(fix, kStart + 900), 0.25);
  fix = go_on(kStart + 901, Pose2(77.0, 0.0, 0.0), 0.2 * (kStart + 901));
  EXPECT_EQ(fix.note, FixNote::kMatched) << "odometry starts anew, anywhere";
}

TEST_F(LocalMapperFaults, OdometryWithoutScansForMinutesIsFollowed) {
  const int later = kStart + 20;
  const LocalFix fix = go_on(later, on_a_circle(later), 0.2 * kStart + 240.0);
  EXPECT_TRUE(fix.is_matched) << to_string(fix.note);
  EXPECT_LT(error_m(fix, later), 0.1);
}

TEST_F(LocalMapperFaults, AScanOfNothingButNoReturnIsABlockedSensorAndLeavesTheMap) {
  const auto cells = mapper_.grid().cells();
  LaserScan scan = laser_.scan(on_a_circle(kStart), 10.0);
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), std::numeric_limits<float>::infinity());
  for (int i = 0; i < 20; ++i) {
    const LocalFix fix = mapper_.absorb({scan, on_a_circle(kStart)});
    EXPECT_EQ(fix.note, FixNote::kBlockedSensor);
    EXPECT_TRUE(is_positive_definite(fix.covariance));
  }
  EXPECT_EQ(mapper_.grid().cells(), cells);
  EXPECT_TRUE(go_on(kStart + 1, on_a_circle(kStart + 1), 12.0).is_matched);
}

TEST_F(LocalMapperFaults, AHandBeforeTheSensorIsABlockedSensorAndLeavesTheMap) {
  const auto cells = mapper_.grid().cells();
  LaserScan scan = laser_.scan(on_a_circle(kStart), 10.0);
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), 0.05F);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(mapper_.absorb({scan, on_a_circle(kStart)}).note, FixNote::kBlockedSensor);
  }
  EXPECT_EQ(mapper_.grid().cells(), cells);
  EXPECT_TRUE(go_on(kStart + 1, on_a_circle(kStart + 1), 12.0).is_matched);
}

TEST_F(LocalMapperFaults, BeamsAndFieldOfViewMayChangeMeanwhile) {
  int step = kStart;
  for (const auto& [beams, span_rad] : std::vector<std::pair<int, double>>{
           {361, kPi}, {90, 2.0}, {682, 4.19}, {30, 2.0 * kPi}, {181, kPi}}) {
    SCOPED_TRACE(beams);
    laser_.set_beams(beams, span_rad);
    for (int i = 0; i < 5; ++i) {
      ++step;
      const LocalFix fix = go_on(step, on_a_circle(step), 0.2 * step);
      EXPECT_TRUE(fix.is_matched) << to_string(fix.note);
      EXPECT_LT(error_m(fix, step), 0.1);
    }
  }
}

TEST_F(LocalMapperFaults, StampsThatRepeatStepBackOrJumpByHoursDoNotMatter) {
  int step = kStart;
  for (const double time_s : {6.2, 6.2, 6.2, 5.0, 0.0, 6.4, 11'000.0, 11'000.2, 3.0, 3.2}) {
    SCOPED_TRACE(time_s);
    ++step;
    const LocalFix fix = go_on(step, on_a_circle(step), time_s);
    EXPECT_EQ(fix.note, FixNote::kMatched) << to_string(fix.note);
    EXPECT_LT(error_m(fix, step), 0.1);
    EXPECT_TRUE(is_positive_definite(fix.motion.covariance));
  }
}

TEST_F(LocalMapperFaults, OdometryThatJumpsIsNotBelievedAndSaysSo) {
  const Pose2 T_jump(400.0, -90.0, 2.0);
  LocalFix fix = go_on(kStart + 1, T_jump * on_a_circle(kStart + 1), 0.2 * (kStart + 1));
  EXPECT_EQ(fix.note, FixNote::kTeleport);
  EXPECT_LT(error_m(fix, kStart + 1), 0.1);
  fix = go_on(kStart + 2, T_jump * on_a_circle(kStart + 2), 0.2 * (kStart + 2));
  EXPECT_EQ(fix.note, FixNote::kMatched) << "and is believed again from there";
}

TEST_F(LocalMapperFaults, ARobotThatBacksUpIsFollowed) {
  LocalFix fix;
  for (int step = kStart - 1; step >= 0; --step) {
    fix = go_on(step, on_a_circle(step), 0.2 * (2 * kStart - step));
    ASSERT_TRUE(fix.is_matched);
  }
  EXPECT_LT(error_m(fix, 0), 0.05);
}

}  // namespace
}  // namespace cairn
