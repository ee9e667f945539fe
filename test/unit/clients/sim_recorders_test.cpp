#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "cairn_lcm/laser_scan_t.hpp"
#include "cairn_lcm/odometry_t.hpp"
#include "clients/sim/recorders.hpp"
#include "clients/sim/simulation.hpp"
#include "clients/sim/text_file.hpp"
#include "lcm/lcm-cpp.hpp"
#include "support/files.hpp"

namespace cairn::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

constexpr std::int64_t kStart_utime = 1'000'000'000'000'000;

class Recorders : public ::testing::Test {
 protected:
  fs::path log_of_seed(unsigned seed, const std::string& name) const {
    const World world = read_world(fs::path(CAIRN_SOURCE_DIR) / "config/worlds/square.txt");
    SimulationOptions options;
    options.seed = seed;
    options.laser.beams = 20;
    const fs::path stem = folder_ / name;
    LogRecorder log(stem.string() + ".log", {"LASER", "ODOMETRY", kStart_utime});
    TruthRecorder truth(stem.string(), kStart_utime);
    RecorderGroup group;
    group.add(log);
    group.add(truth);
    const std::atomic<bool> never{false};
    simulate(world, tour_named(world, "loop"), options, never, group);
    log.close();
    truth.close();
    return stem;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Recorders, TheSameSeedGivesTheSameBytes) {
  const fs::path first = log_of_seed(1, "first");
  const fs::path second = log_of_seed(1, "second");
  const fs::path other = log_of_seed(2, "other");
  for (const char* const ending : {".log", ".truth.txt", ".junctions.txt"}) {
    SCOPED_TRACE(ending);
    EXPECT_FALSE(read_text(first.string() + ending).empty());
    EXPECT_TRUE(read_text(first.string() + ending) == read_text(second.string() + ending));
  }
  EXPECT_FALSE(read_text(first.string() + ".log") == read_text(other.string() + ".log"));
}

TEST_F(Recorders, TheLogIsReadByLcmItself) {
  const fs::path stem = log_of_seed(1, "drive");
  lcm::LogFile log(stem.string() + ".log", "r");
  ASSERT_TRUE(log.good());
  std::int64_t sweeps = 0;
  std::int64_t readings = 0;
  std::int64_t last_utime = kStart_utime;
  while (const lcm::LogEvent* const event = log.readNextEvent()) {
    EXPECT_EQ(event->eventnum, sweeps + readings);
    EXPECT_GE(event->timestamp, last_utime);
    last_utime = event->timestamp;
    cairn_lcm::laser_scan_t sweep;
    cairn_lcm::odometry_t reading;
    if (event->channel == "LASER") {
      ASSERT_EQ(sweep.decode(event->data, 0, event->datalen), event->datalen);
      EXPECT_EQ(sweep.utime, event->timestamp);
      EXPECT_EQ(sweep.num_ranges, 20);
      ++sweeps;
    } else {
      EXPECT_EQ(event->channel, "ODOMETRY");
      ASSERT_EQ(reading.decode(event->data, 0, event->datalen), event->datalen);
      EXPECT_EQ(reading.utime, event->timestamp);
      ++readings;
    }
  }
  EXPECT_GT(sweeps, 500);
  EXPECT_NEAR(static_cast<double>(readings) / static_cast<double>(sweeps), 2.0, 0.01);
}

TEST_F(Recorders, TheTruthHasALinePerSweepWithTheSameTime) {
  const fs::path stem = log_of_seed(1, "drive");
  EXPECT_THAT(read_text(stem.string() + ".truth.txt"),
              StartsWith("# t_s x_m y_m theta_rad\n1000000000.030000 "));
  EXPECT_THAT(read_text(stem.string() + ".junctions.txt"),
              StartsWith("# t_s name x_m y_m\n1000000000.000000 A "));
}

TEST_F(Recorders, AFileThatCannotBeWrittenIsNamed) {
  try {
    LogRecorder log("/no/such/folder/x.log", {"LASER", "ODOMETRY", 0});
    FAIL();
  } catch (const CannotWrite& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/folder/x.log"));
  }
  EXPECT_THROW(TruthRecorder("/no/such/folder/x", 0), CannotWrite);
}

TEST_F(Recorders, AFullDiskIsNoticed) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full here";
  }
  const auto fill = [] {
    LogRecorder log("/dev/full", {"LASER", "ODOMETRY", 0});
    for (int i = 0; i < 10'000; ++i) {
      log.record_odometry(i, {});
    }
    log.close();
  };
  EXPECT_THROW(fill(), CannotWrite);
}

TEST_F(Recorders, ABusThatDoesNotExistIsNamed) {
  const std::atomic<bool> never{false};
  EXPECT_THROW(LiveRecorder("nosuchbus://", {"LASER", "ODOMETRY", 0}, 1.0, never), NoBus);
}

TEST_F(Recorders, AStoppedLiveDriveDoesNotWait) {
  const std::atomic<bool> stopped{true};
  LiveRecorder live("memq://", {"LASER", "ODOMETRY", 0}, 1.0, stopped);
  live.record_odometry(std::int64_t{1} << 40U, {});  // A dozen days ahead.
}

}  // namespace
}  // namespace cairn::sim
