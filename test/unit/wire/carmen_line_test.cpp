#include "wire/carmen_line.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;

constexpr double kDeg = std::numbers::pi / 180.0;

template <class T>
T parsed_as(const std::string& line) {
  const CarmenLine parsed = parse_carmen_line(line);
  const T* const value = std::get_if<T>(&parsed);
  EXPECT_NE(value, nullptr) << line;
  return value == nullptr ? T{} : *value;
}

std::string flaser(int beams, const std::string& tail) {
  std::string line = "FLASER " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) {
    line += " 1.5";
  }
  return line + tail;
}

CarmenScan scan_with(int beams) {
  return parsed_as<CarmenScan>(flaser(beams, " 9 9 9 1 2 0.5 976052857.348896 host 0.1"));
}

TEST(CarmenLine, OdometryIsStampedWithItsIpcTime) {
  const auto odometry =
      parsed_as<CarmenOdometry>("ODOM 1.5 -2 0.25 0 0 0 976052857.337530 host 0.000001");
  EXPECT_EQ(odometry.utime, 976052857337530);
  EXPECT_DOUBLE_EQ(odometry.T_odom_robot.x_m, 1.5);
  EXPECT_DOUBLE_EQ(odometry.T_odom_robot.y_m, -2.0);
  EXPECT_DOUBLE_EQ(odometry.T_odom_robot.theta_rad, 0.25);
}

TEST(CarmenLine, AScanCarriesTheSecondTripleAsOdometry) {
  const CarmenScan scan = scan_with(180);
  EXPECT_EQ(scan.utime, 976052857348896);
  ASSERT_TRUE(scan.T_odom_robot.has_value());
  EXPECT_DOUBLE_EQ(scan.T_odom_robot->x_m, 1.0);
  EXPECT_DOUBLE_EQ(scan.T_odom_robot->theta_rad, 0.5);
}

TEST(CarmenLine, OldScansHaveOneTripleOnly) {
  const auto scan = parsed_as<CarmenScan>(flaser(5, " 1 2 0.5 10.0 host 0.1"));
  ASSERT_TRUE(scan.T_odom_robot.has_value());
  EXPECT_DOUBLE_EQ(scan.T_odom_robot->x_m, 1.0);
  EXPECT_EQ(scan.utime, 10'000'000);
}

TEST(CarmenLine, TheNumberOfBeamsTellsWhereTheyPoint) {
  const auto first_and_last_deg = [](int beams) {
    const CarmenScan scan = scan_with(beams);
    return std::pair(scan.first_bearing_rad / kDeg,
                     (scan.first_bearing_rad + (beams - 1) * scan.bearing_step_rad) / kDeg);
  };
  const auto expect = [&](int beams, double first_deg, double last_deg) {
    const auto [first, last] = first_and_last_deg(beams);
    EXPECT_NEAR(first, first_deg, 1e-9) << beams;
    EXPECT_NEAR(last, last_deg, 1e-9) << beams;
  };
  expect(180, -90.0, 89.0);
  expect(181, -90.0, 90.0);
  expect(360, -90.0, 89.5);
  expect(361, -90.0, 90.0);
  expect(401, -50.0, 50.0);
  expect(682, -119.7198, 119.7198);
  expect(91, -90.0, 90.0);
}

TEST(CarmenLine, RobotLaserSaysItselfWhereItsBeamsPoint) {
  const auto scan = parsed_as<CarmenScan>(
      "ROBOTLASER1 0 -1.5 3.0 1.5 20.0 0.01 0 3 1 2 3 2 7 7 "
      "0.3 0 0 4 5 0.5 0 0 0.1 0.1 1000 12.5 host 0.1");
  EXPECT_EQ(scan.laser, 1);
  EXPECT_EQ(scan.utime, 12'500'000);
  EXPECT_DOUBLE_EQ(scan.first_bearing_rad, -1.5);
  EXPECT_DOUBLE_EQ(scan.bearing_step_rad, 1.5);
  EXPECT_DOUBLE_EQ(scan.stated_max_range_m, 20.0);
  EXPECT_THAT(scan.ranges_m, ElementsAre(1.0F, 2.0F, 3.0F));
  ASSERT_TRUE(scan.T_odom_robot.has_value());
  EXPECT_DOUBLE_EQ(scan.T_odom_robot->x_m, 4.0);
}

TEST(CarmenLine, RawLaserHasNoOdometry) {
  const auto scan =
      parsed_as<CarmenScan>("RAWLASER2 0 -1.5 3.0 0 20.0 0.01 0 3 1 2 3 0 12.5 host 0.1");
  EXPECT_EQ(scan.laser, 2);
  EXPECT_FALSE(scan.T_odom_robot.has_value());
  EXPECT_DOUBLE_EQ(scan.bearing_step_rad, 1.5);
}

TEST(CarmenLine, OtherLinesAreNamed) {
  EXPECT_EQ(parsed_as<CarmenOther>("# a comment").name, "");
  EXPECT_EQ(parsed_as<CarmenOther>("").name, "");
  EXPECT_EQ(parsed_as<CarmenOther>("PARAM robot_length 0.5").name, "PARAM");
  EXPECT_EQ(parsed_as<CarmenOther>("SYNC 1").name, "SYNC");
}

TEST(CarmenLine, CutAnywhereItIsNoMessage) {
  const std::string line =
      "ROBOTLASER1 0 -1.5 3.0 1.5 20.0 0.01 0 3 1 2 3 2 7 7 "
      "0.3 0 0 4 5 0.5 0 0 0.1 0.1 1000 12.5 host";
  for (const std::string& whole :
       {line, std::string("ODOM 1 2 3 0 0 0 1.5 host"), flaser(4, " 9 9 9 1 2 3 1.5 host")}) {
    for (std::size_t size = 1; size <= whole.size(); ++size) {
      const CarmenLine parsed = parse_carmen_line(whole.substr(0, size));
      EXPECT_TRUE(std::holds_alternative<CarmenMalformed>(parsed) ||
                  std::holds_alternative<CarmenOther>(parsed))
          << whole.substr(0, size);
    }
  }
}

TEST(CarmenLine, ImpossibleCountsAreMalformed) {
  for (const char* const line :
       {"FLASER 99999999999 1 2 3 4 5 6 7 h 8", "FLASER -1 1 2 3 4 5 6 7 h 8",
        "FLASER 18446744073709551610 1 2 3 4 5 6 7 h 8",
        "ROBOTLASER1 0 0 0 0 0 0 0 18446744073709551610 1 1 1 1",
        "RAWLASER1 0 0 0 0 0 0 0 1 1 18446744073709551610 1 h 1"}) {
    parsed_as<CarmenMalformed>(line);
  }
}

double max_range_of(const std::vector<std::pair<float, int>>& readings) {
  NoReturnFinder finder;
  for (const auto& [range_m, times] : readings) {
    for (int i = 0; i < times; ++i) {
      finder.add(range_m);
    }
  }
  return finder.max_range_m();
}

TEST(NoReturnFinder, AFrequentLargestReadingMeansNoReturn) {
  const double limit_m = max_range_of({{3.0F, 5000}, {81.83F, 40}});
  EXPECT_LT(limit_m, static_cast<double>(81.83F));
  EXPECT_GT(limit_m, 81.8);
}

TEST(NoReturnFinder, SeveralCodesCloseToEachOtherAllMeanNoReturn) {
  const double limit_m = max_range_of({{81.91F, 100}, {3.0F, 50'000}, {81.87F, 600}, {81.5F, 2}});
  EXPECT_LT(limit_m, static_cast<double>(81.87F));
  EXPECT_GT(limit_m, 81.5);
}

TEST(NoReturnFinder, ARareLargestReadingIsAWall) {
  EXPECT_GT(max_range_of({{3.0F, 5000}, {12.5F, 3}}), 12.5);
  EXPECT_LT(max_range_of({{3.0F, 5000}, {12.5F, 3}}), 12.6);
}

TEST(NoReturnFinder, IgnoresWhatIsNoReading) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(max_range_of({{infinity, 50}, {std::nanf(""), 50}, {0.0F, 50}, {-1.0F, 50}}), 0.0);
}

}  // namespace
}  // namespace cairn::wire
