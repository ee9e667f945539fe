// Replays of logs: the same twice, damaged ones, and recorded ones.

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "process.hpp"
#include "support/recorded_data.hpp"

namespace cairn::test {
namespace {

using ::testing::HasSubstr;

class ReplayTest : public ::testing::Test {
 protected:
  Finished replay(const std::string& log, const std::string& map) {
    return run({CAIRND, "--replay", log, "--map", (folder_ / map).string()}, folder_);
  }
  std::string simulated(const std::string& tour) {
    const std::string log = (folder_ / (tour + ".log")).string();
    const Finished result =
        run({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/square.txt", "--tour", tour, "--log", log},
            folder_);
    EXPECT_EQ(result.status, 0) << result.errors;
    return log;
  }
  std::string exported(const std::string& map) {
    const std::string file = (folder_ / (map + ".txt")).string();
    const Finished result =
        run({CAIRN, "export", "--trajectory", file, (folder_ / map).string()}, folder_);
    EXPECT_EQ(result.status, 0) << result.errors;
    return content_of(file);
  }

  TemporaryFolder folder_;
};

TEST_F(ReplayTest, TheSameLogGivesTheSameBytes) {
  const std::string log = simulated("loop");
  EXPECT_EQ(replay(log, "a").status, 0);
  EXPECT_EQ(replay(log, "b").status, 0);
  EXPECT_EQ(content_of(folder_ / "a"), content_of(folder_ / "b"));
  EXPECT_EQ(exported("a"), exported("b"));
}

TEST_F(ReplayTest, NeverWritesOverAMap) {
  const std::string log = simulated("loop");
  EXPECT_EQ(replay(log, "a").status, 0);
  const std::string before = content_of(folder_ / "a");
  const Finished again = replay(log, "a");
  EXPECT_EQ(again.status, 73);
  EXPECT_THAT(again.errors, HasSubstr("is there already"));
  EXPECT_EQ(content_of(folder_ / "a"), before);
}

TEST_F(ReplayTest, ATruncatedLogIsToldWithItsByteAndWhatWasReadIsKept) {
  const std::string log = simulated("loop");
  const std::string bytes = content_of(log);
  write_file(folder_ / "cut.log", bytes.substr(0, bytes.size() / 2));
  const Finished result = replay((folder_ / "cut.log").string(), "a");
  EXPECT_EQ(result.status, 65);
  EXPECT_THAT(result.errors, HasSubstr("byte"));
  EXPECT_GT(exported("a").size(), 1000U);
}

TEST_F(ReplayTest, AnEmptyOrMissingLogIsBadData) {
  write_file(folder_ / "empty.clf", "");
  EXPECT_EQ(replay((folder_ / "empty.clf").string(), "a").status, 65);
  EXPECT_EQ(replay((folder_ / "missing.clf").string(), "b").status, 65);
}

TEST_F(ReplayTest, ALogWithoutScansIsBadData) {
  write_file(folder_ / "odometry.clf",
             "ODOM 0 0 0 0 0 0 1.0 robot 1.0\nODOM 0 0 0 0 0 0 2.0 robot 2.0\n");
  const Finished result = replay((folder_ / "odometry.clf").string(), "a");
  EXPECT_EQ(result.status, 65);
  EXPECT_THAT(result.errors, HasSubstr("no scan in"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a")) << "it would stand in the next one's way";
  EXPECT_EQ(replay(simulated("loop"), "a").status, 0);
}

TEST_F(ReplayTest, ABrokenCarmenLineIsToldWithItsNumber) {
  write_file(folder_ / "bad.clf",
             "ODOM 0 0 0 0 0 0 1.0 robot 1.0\nFLASER 3 1.0 2.0\nODOM 0 0 0 0 0 0 2.0 robot 2.0\n");
  const Finished result = replay((folder_ / "bad.clf").string(), "a");
  EXPECT_EQ(result.status, 65);
  EXPECT_THAT(result.errors, HasSubstr("line 2"));
}

TEST_F(ReplayTest, AConvertedLogGivesTheSameMapAsTheOriginal) {
  CAIRN_NEED_DATA("laser/duke_loop5/loop5.clf");
  const std::string original = recorded_data("laser/duke_loop5/loop5.clf").string();
  const std::string converted = (folder_ / "loop5.log").string();
  EXPECT_EQ(run({CAIRN, "log", "convert", original, converted}, folder_).status, 0);
  EXPECT_EQ(replay(original, "a").status, 0);
  EXPECT_EQ(replay(converted, "b").status, 0);
  EXPECT_EQ(content_of(folder_ / "a"), content_of(folder_ / "b"));
}

class RecordedLogTest : public ReplayTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(RecordedLogTest, IsReadWithoutError) {
  CAIRN_NEED_DATA(GetParam());
  const Finished result = replay(recorded_data(GetParam()).string(), "a");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("times real time"));
  EXPECT_GT(exported("a").size(), 1000U);
}

INSTANTIATE_TEST_SUITE_P(Every,
                         RecordedLogTest,
                         ::testing::Values("carmen/aces/aces.clf",
                                           "carmen/csail/csail.clf",
                                           "carmen/seattle/seattle.clf",
                                           "laser/cmu_wean/robotdata1.clf",
                                           "laser/cmu_wean/robotdata5.clf",
                                           "laser/duke_loop5/loop5.clf",
                                           "laser/mines/exp1.clf",
                                           "lcm/mbot_convex.log",
                                           "lcm/mbot_drive_square_truth.log"),
                         [](const ::testing::TestParamInfo<const char*>& log) {
                           return std::filesystem::path(log.param).stem().string();
                         });

}  // namespace
}  // namespace cairn::test
