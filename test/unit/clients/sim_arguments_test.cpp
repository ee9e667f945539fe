#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "clients/sim/arguments.hpp"

namespace cairn::sim {
namespace {

struct Parsed {
  std::optional<Arguments> arguments;
  int exit_code = -1;
};

Parsed parsed(const std::vector<const char*>& options) {
  std::vector<const char*> words = {"cairn-sim"};
  for (const char* const option : options) {
    words.push_back(option);
  }
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Parsed result;
  result.arguments =
      parse_arguments(static_cast<int>(words.size()), words.data(), result.exit_code);
  ::testing::internal::GetCapturedStdout();
  ::testing::internal::GetCapturedStderr();
  return result;
}

TEST(Arguments, TheDefaultsAreALiveDriveInRealTime) {
  const Parsed result = parsed({"w.txt"});
  ASSERT_TRUE(result.arguments);
  EXPECT_EQ(result.arguments->world_file, "w.txt");
  EXPECT_EQ(result.arguments->speed, 1.0);
  EXPECT_TRUE(result.arguments->log_file.empty());
  EXPECT_EQ(result.arguments->simulation.laser.beams, 360);
  EXPECT_EQ(result.arguments->laser_channel, "LASER");
}

TEST(Arguments, OptionsReachTheSimulation) {
  const Parsed result = parsed({"w.txt", "--log", "x.log", "--seed", "7", "--beams", "181",
                                "--fov-deg", "180", "--start-utime", "12"});
  ASSERT_TRUE(result.arguments);
  EXPECT_EQ(result.arguments->simulation.seed, 7U);
  EXPECT_EQ(result.arguments->simulation.laser.beams, 181);
  EXPECT_EQ(result.arguments->simulation.laser.fov_deg, 180.0);
  EXPECT_EQ(result.arguments->start_utime, 12);
}

TEST(Arguments, ADriftOfZeroSwitchesAllErrorsOff) {
  const Parsed result = parsed({"w.txt", "--odometry-drift", "0"});
  ASSERT_TRUE(result.arguments);
  EXPECT_EQ(result.arguments->simulation.odometer.scale_error, 0.0);
  EXPECT_EQ(result.arguments->simulation.odometer.heading_noise_rad_per_sqrt_rad, 0.0);
}

TEST(Arguments, WhatIsWrongIsAUsageError) {
  const std::vector<std::vector<const char*>> wrong = {
      {},
      {"w.txt", "--no-such-option"},
      {"w.txt", "extra.txt"},
      {"w.txt", "--beams", "1"},
      {"w.txt", "--beams", "many"},
      {"w.txt", "--fov-deg", "nan"},
      {"w.txt", "--speed", "0"},
      {"w.txt", "--seed", "-1"},
      {"w.txt", "--laser-channel", ""},
      {"plan.png"},
      {"w.txt", "--tour-file", "t.txt"},
      {"w.txt", "--m-per-pixel", "0.1"},
      {"w.txt", "--log", "x.log", "--speed", "2"},
      {"w.txt", "--log", "x.log", "--lcm-url", "memq://"},
  };
  for (const std::vector<const char*>& words : wrong) {
    SCOPED_TRACE(::testing::PrintToString(words));
    const Parsed result = parsed(words);
    EXPECT_FALSE(result.arguments);
    EXPECT_EQ(result.exit_code, 64);
  }
}

TEST(Arguments, HelpAndVersionEndWell) {
  for (const char* const word : {"--help", "--version"}) {
    const Parsed result = parsed({word});
    EXPECT_FALSE(result.arguments);
    EXPECT_EQ(result.exit_code, 0);
  }
}

}  // namespace
}  // namespace cairn::sim
