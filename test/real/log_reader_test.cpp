#include "wire/log_reader.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <cairn_lcm/laser_scan_t.hpp>
#include <cairn_lcm/odometry_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recorded_data.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr std::size_t kMaxBytes = 1 << 20;

struct Contents {
  std::map<std::string, int> messages;  ///< By channel.
  std::int64_t num_beams = 0;           ///< Of the last scan.
  double max_range_m = 0.0;
  double no_return_share = 0.0;
  std::int64_t bytes_read = 0;
};

Contents read_all(const std::string& file) {
  Contents contents;
  Expected<LogReader> log = LogReader::open(test::recorded_data(file).string());
  if (!log) {
    ADD_FAILURE() << log.error();
    return contents;
  }
  std::int64_t readings = 0;
  std::int64_t no_returns = 0;
  while (const std::optional<LogMessage> message = log->next()) {
    ++contents.messages[message->channel];
    const auto scan = decode<cairn_lcm::laser_scan_t>(message->bytes, kMaxBytes);
    if (!scan) {
      continue;
    }
    EXPECT_EQ(scan->utime, message->utime);
    contents.num_beams = scan->num_ranges;
    contents.max_range_m = scan->max_range_m;
    readings += scan->num_ranges;
    for (const float range_m : scan->ranges_m) {
      no_returns += static_cast<double>(range_m) > scan->max_range_m ? 1 : 0;
    }
  }
  EXPECT_EQ(log->damage(), std::nullopt) << log->damage().value_or("");
  EXPECT_EQ(log->bytes_read(), log->bytes_total());
  contents.no_return_share =
      readings == 0 ? 0.0 : static_cast<double>(no_returns) / static_cast<double>(readings);
  return contents;
}

struct Expectation {
  const char* file;
  int scans;
  int odometry;  ///< Of ODOM lines; each scan brings one more.
  int beams;
  double max_range_m;
  double no_return_share;
};

TEST(RecordedLogs, CarmenLogsAreReadToTheirEnd) {
  const Expectation logs[] = {
      {"carmen/intel/intel.clf", 4518, 13631, 180, 81.83, 0.0258},
      {"carmen/fr079/fr079.clf", 4791, 4934, 360, 81.91, 0.0209},
      {"carmen/aces/aces.clf", 440, 7374, 180, 50.0, 0.0078},
      {"carmen/csail/csail.clf", 1988, 0, 361, 81.91, 0.033},
      {"carmen/seattle/seattle.clf", 241, 19070, 361, 81.87, 0.0081},
      {"laser/cmu_wean/robotdata1.clf", 713, 1505, 180, 81.83, 0.0054},
      {"laser/cmu_wean/robotdata5.clf", 1313, 2328, 180, 81.83, 0.0146},
      {"laser/duke_loop5/loop5.clf", 551, 551, 181, 8.183, 0.0674},
      {"laser/mines/exp1.clf", 756, 756, 682, 81.91, 0.5526},
  };
  for (const Expectation& log : logs) {
    SCOPED_TRACE(log.file);
    CAIRN_NEED_DATA(log.file);
    const Contents contents = read_all(log.file);
    EXPECT_THAT(contents.messages,
                ElementsAre(Pair("LASER", log.scans), Pair("ODOMETRY", log.scans + log.odometry)));
    EXPECT_EQ(contents.num_beams, log.beams);
    EXPECT_LT(contents.max_range_m, log.max_range_m);
    EXPECT_NEAR(contents.max_range_m, log.max_range_m, 1e-4);
    EXPECT_NEAR(contents.no_return_share, log.no_return_share, 1e-3);
  }
}

TEST(RecordedLogs, LcmLogsAreReadToTheirEnd) {
  CAIRN_NEED_DATA("lcm/mbot_convex.log");
  const Contents convex = read_all("lcm/mbot_convex.log");
  EXPECT_EQ(convex.messages.at("RPLIDAR_LASER"), 459);
  CAIRN_NEED_DATA("lcm/mbot_drive_square_truth.log");
  const Contents square = read_all("lcm/mbot_drive_square_truth.log");
  EXPECT_EQ(square.messages.at("LIDAR"), 125);
  EXPECT_EQ(square.messages.at("ODOMETRY"), 1240);
}

TEST(RecordedLogs, AScanComesRightAfterItsOwnOdometry) {
  CAIRN_NEED_DATA("laser/cmu_wean/robotdata1.clf");
  Expected<LogReader> log =
      LogReader::open(test::recorded_data("laser/cmu_wean/robotdata1.clf").string());
  ASSERT_TRUE(log.ok());
  std::optional<LogMessage> before;
  while (std::optional<LogMessage> message = log->next()) {
    if (message->channel == "LASER") {
      ASSERT_TRUE(before.has_value());
      EXPECT_EQ(before->channel, "ODOMETRY");
      EXPECT_EQ(before->utime, message->utime);
    }
    before = std::move(message);
  }
}

}  // namespace
}  // namespace cairn::wire
