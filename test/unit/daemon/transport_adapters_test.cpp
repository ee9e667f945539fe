#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_samples.hpp"
#include "transport/adapters.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

MATCHER(IsNoStatement, "") {
  return std::isnan(arg);
}

template <class Message>
Result<LaserScan> scan_from(const Message& message, const LaserChannelOptions& options = {}) {
  const wire::Bytes bytes = wire::encode(message);
  return scan_of(bytes.data(), bytes.size(), options);
}

template <class Message>
Result<OdometrySample> odometry_from(const Message& message) {
  const wire::Bytes bytes = wire::encode(message);
  return odometry_of(bytes.data(), bytes.size());
}

cairn_lcm::laser_scan_t own_scan() {
  return test::sample<cairn_lcm::laser_scan_t>();
}

TEST(ScanAdapter, OwnScansKeepTheirBearingsAndStamp) {
  const Result<LaserScan> scan = scan_from(own_scan());
  ASSERT_TRUE(scan.ok());
  EXPECT_EQ(utime_of(scan->time), 1'000'000);
  EXPECT_THAT(scan->bearings_rad, ElementsAre(-1.0F, -0.5F, 0.0F, 0.5F, 1.0F));
  EXPECT_THAT(scan->ranges_m, ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, 5.0F));
  EXPECT_EQ(scan->max_range_m, 10.0);
}

TEST(ScanAdapter, ReadingsTakeTheirMeaning) {
  auto message = own_scan();
  message.ranges_m = {std::nanf(""), 0.0F, -3.0F, kNoReturn, 10.1F};
  const Result<LaserScan> scan = scan_from(message);
  ASSERT_TRUE(scan.ok());
  EXPECT_THAT(scan->ranges_m,
              ElementsAre(IsNoStatement(), IsNoStatement(), IsNoStatement(), kNoReturn, kNoReturn));
}

TEST(ScanAdapter, LimitsOfTheConfigurationGoBeforeThoseOfTheMessage) {
  LaserChannelOptions options;
  options.min_range_m = 1.5;
  options.max_range_m = 4.5;
  const Result<LaserScan> scan = scan_from(own_scan(), options);
  ASSERT_TRUE(scan.ok());
  EXPECT_THAT(scan->ranges_m, ElementsAre(IsNoStatement(), 2.0F, 3.0F, 4.0F, kNoReturn));
  EXPECT_EQ(scan->max_range_m, 4.5);
}

TEST(ScanAdapter, WithoutAnyLimitTheLongestReadingIsIt) {
  auto message = test::sample<bot_core::planar_lidar_t>();
  message.ranges = {1.0F, kNoReturn, 3.0F};
  const Result<LaserScan> scan = scan_from(message);
  ASSERT_TRUE(scan.ok());
  EXPECT_EQ(scan->max_range_m, 3.0);
  EXPECT_THAT(scan->ranges_m, ElementsAre(1.0F, kNoReturn, 3.0F));
  EXPECT_THAT(scan->bearings_rad, ElementsAre(-0.5F, 0.0F, 0.5F));
}

TEST(ScanAdapter, MbotAnglesRunClockwiseUnlessSaidOtherwise) {
  const auto message = test::sample<mbot_lcm_msgs::lidar_t>();
  const Result<LaserScan> scan = scan_from(message);
  ASSERT_TRUE(scan.ok());
  EXPECT_THAT(scan->bearings_rad, ElementsAre(0.0F, -0.5F, -1.0F));
  EXPECT_THAT(scan->ranges_m, ElementsAre(1.0F, IsNoStatement(), 3.0F));
  EXPECT_NEAR(scan->sweep_duration_s, 0.1, 1e-9);
  LaserChannelOptions options;
  options.theta_sign = 1.0;
  EXPECT_THAT(scan_from(message, options)->bearings_rad, ElementsAre(0.0F, 0.5F, 1.0F));
}

TEST(ScanAdapter, ASpinningLidarMayGoBeyondTheFullTurn) {
  auto message = test::sample<mbot_lcm_msgs::lidar_t>();
  message.thetas = {0.0F, 3.0F, 6.4F};
  const Result<LaserScan> scan = scan_from(message);
  ASSERT_TRUE(scan.ok()) << scan.error().message;
  EXPECT_NEAR(scan->bearings_rad[2], -6.4 + 2.0 * kPi, 1e-5);
}

TEST(ScanAdapter, VulcanNegativeReadingsAreInvalidAndTheMountIsInTheMessage) {
  LaserChannelOptions options;
  options.T_robot_laser = {1.0, 0.0, 0.0};
  const auto check = [](const Result<LaserScan>& scan) {
    ASSERT_TRUE(scan.ok()) << scan.error().message;
    EXPECT_THAT(scan->ranges_m, ElementsAre(1.0F, IsNoStatement(), kNoReturn));
    EXPECT_NEAR(scan->T_robot_laser.x(), 1.3, 1e-6);
  };
  check(scan_from(test::sample<vulcan_lcm::laser_t>(), options));
  check(scan_from(test::sample<vulcan_lcm::laser_3dof_t>(), options));
}

TEST(ScanAdapter, ALaserUpsideDownSweepsTheOtherWay) {
  auto message = test::sample<vulcan_lcm::laser_t>();
  message.offset_roll = 3.14F;
  EXPECT_THAT(scan_from(message)->bearings_rad, ElementsAre(0.5F, 0.0F, -0.5F));
  message.offset_roll = 0.5F;
  EXPECT_THAT(scan_from(message).error().message, HasSubstr("not mounted level"));
}

TEST(ScanAdapter, WhatCannotBeAScanIsRefused) {
  const auto code_of = [](auto change) {
    auto message = own_scan();
    change(message);
    const Result<LaserScan> scan = scan_from(message);
    return scan.ok() ? ErrorCode::kNotConverged : scan.error().code;
  };
  EXPECT_EQ(code_of([](auto& scan) { scan.utime = 0; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) { scan.utime = -5; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) { scan.first_bearing_rad = std::nan(""); }),
            ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) { scan.bearing_step_rad = 2.0; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) { scan.max_range_m = -1.0; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) { scan.max_range_m = std::nan(""); }), ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) {
              scan.ranges_m = {1.0F};
              scan.num_ranges = 1;
            }),
            ErrorCode::kInvalidValue);
  EXPECT_EQ(code_of([](auto& scan) {
              scan.ranges_m.assign(10'001, 1.0F);
              scan.bearing_step_rad = 1e-5;
              scan.num_ranges = 10'001;
            }),
            ErrorCode::kInvalidValue);
}

TEST(ScanAdapter, AScanWithoutAnyReadingAndWithoutALimitIsRefused) {
  auto message = test::sample<mbot_lcm_msgs::lidar_t>();
  message.ranges = {0.0F, 0.0F, 0.0F};
  EXPECT_FALSE(scan_from(message).ok());
}

TEST(ScanAdapter, TellsDamageFromUnknownTypes) {
  wire::Bytes bytes = wire::encode(own_scan());
  bytes.pop_back();
  EXPECT_EQ(scan_of(bytes.data(), bytes.size(), {}).error().code, ErrorCode::kMalformed);
  EXPECT_EQ(scan_of(bytes.data(), 3, {}).error().code, ErrorCode::kMalformed);
  const Result<LaserScan> other = scan_from(test::sample<cairn_lcm::odometry_t>());
  EXPECT_EQ(other.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(other.error().message, HasSubstr("0x"));
}

TEST(OdometryAdapter, EveryAcceptedTypeGivesThePose) {
  const auto expect_pose = [](const Result<OdometrySample>& sample) {
    ASSERT_TRUE(sample.ok()) << sample.error().message;
    EXPECT_EQ(utime_of(sample->time), 5);
    EXPECT_NEAR(sample->T_odom_robot.x(), 1.0, 1e-6);
    EXPECT_NEAR(sample->T_odom_robot.y(), 2.0, 1e-6);
    EXPECT_NEAR(sample->T_odom_robot.theta(), 0.5, 1e-6);
  };
  cairn_lcm::odometry_t own{};
  own.utime = 5;
  own.x_m = 1.0;
  own.y_m = 2.0;
  own.theta_rad = 0.5;
  expect_pose(odometry_from(own));
  bot_core::pose_t bot{};
  bot.utime = 5;
  bot.pos[0] = 1.0;
  bot.pos[1] = 2.0;
  bot.orientation[0] = std::cos(0.25);
  bot.orientation[3] = std::sin(0.25);
  expect_pose(odometry_from(bot));
  mbot_lcm_msgs::pose2D_t mbot{};
  mbot.utime = 5;
  mbot.x = 1.0F;
  mbot.y = 2.0F;
  mbot.theta = 0.5F;
  expect_pose(odometry_from(mbot));
  vulcan_lcm::odometry_t vulcan{};
  vulcan.timestamp = 5;
  vulcan.x = 1.0;
  vulcan.y = 2.0;
  vulcan.theta = 0.5;
  expect_pose(odometry_from(vulcan));
}

TEST(OdometryAdapter, WhatCannotBeAPoseIsRefused) {
  auto bot = test::sample<bot_core::pose_t>();
  EXPECT_TRUE(odometry_from(bot).ok());
  bot.orientation[0] = 0.9;
  EXPECT_THAT(odometry_from(bot).error().message, HasSubstr("unit quaternion"));
  cairn_lcm::odometry_t own{};
  own.utime = 1;
  EXPECT_TRUE(odometry_from(own).ok());
  own.x_m = std::nan("");
  EXPECT_FALSE(odometry_from(own).ok());
  own.x_m = 1e7;
  EXPECT_FALSE(odometry_from(own).ok());
  own.x_m = 0.0;
  own.theta_rad = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(odometry_from(own).ok());
  own.theta_rad = 0.0;
  own.utime = 0;
  EXPECT_FALSE(odometry_from(own).ok());
}

TEST(SonarAdapter, SensorsSitWhereTheMessageSays) {
  auto message = test::sample<cairn_lcm::sonar_ring_t>();
  message.ranges_m = {1.0F, 0.0F, kNoReturn};
  wire::Bytes bytes = wire::encode(message);
  const Result<SonarRing> ring = sonar_of(bytes.data(), bytes.size());
  ASSERT_TRUE(ring.ok());
  EXPECT_THAT(ring->ranges_m, ElementsAre(1.0F, IsNoStatement(), kNoReturn));
  EXPECT_NEAR(ring->T_robot_sensor[1].x(), 0.2, 1e-6);
  message.bearing_rad[2] = std::nanf("");
  bytes = wire::encode(message);
  EXPECT_FALSE(sonar_of(bytes.data(), bytes.size()).ok());
}

TEST(LaserChannelOptions, AllThatIsWrongIsNamedAtOnce) {
  LaserChannelOptions options;
  EXPECT_TRUE(validate(options).ok());
  options.theta_sign = 0.5;
  options.min_range_m = 5.0;
  options.max_range_m = 4.0;
  options.channel = "";
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  for (const char* const field : {"theta_sign", "max_range_m", "channel"}) {
    EXPECT_THAT(status.error().message, HasSubstr(field));
  }
}

}  // namespace
}  // namespace cairn
