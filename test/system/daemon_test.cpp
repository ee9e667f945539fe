// cairnd as a process: start, stop, and every wrong thing a stranger may type or send.

#include <csignal>

#include <cairn_lcm/laser_scan_t.hpp>
#include <cairn_lcm/odometry_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <gmock/gmock.h>

#include "process.hpp"
#include "wire/bus.hpp"
#include "wire/signatures.hpp"

namespace cairn::test {
namespace {

using ::testing::HasSubstr;

std::int64_t now_utime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

class DaemonTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string map() const { return (folder_ / "a.cairn").string(); }
  Finished cairnd(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), CAIRND);
    return run(arguments, folder_);
  }
  std::string config(const std::string& text) {
    write_file(folder_ / "cairnd.json", text);
    return (folder_ / "cairnd.json").string();
  }

  TemporaryFolder folder_;
};

TEST_F(DaemonTest, AnUnknownArgumentIsAUsageError) {
  EXPECT_EQ(cairnd({"--colour", "red"}).status, 64);
}

TEST_F(DaemonTest, AnUnknownOrOutOfRangeOptionNamesOptionRangeAndValue) {
  const Finished result =
      cairnd({"--check-config", "--config", config(R"({"lpm":{"map":{"cell_m":7},"x":1}})")});
  EXPECT_EQ(result.status, 78);
  EXPECT_THAT(result.errors, HasSubstr("lpm.map.cell_m must be in [0.01, 0.5], is 7"));
  EXPECT_THAT(result.errors, HasSubstr("lpm.x is not an option"));
}

TEST_F(DaemonTest, AConfigurationThatIsMissingOrNoJsonIsAConfigurationError) {
  EXPECT_EQ(cairnd({"--check-config", "--config", "/no/such/file"}).status, 78);
  EXPECT_EQ(cairnd({"--check-config", "--config", config("{")}).status, 78);
}

TEST_F(DaemonTest, ItsOwnConfigurationIsSound) {
  const Finished dumped = cairnd({"--dump-config"});
  EXPECT_EQ(dumped.status, 0);
  EXPECT_EQ(cairnd({"--check-config", "--config", config(dumped.output)}).status, 0);
}

TEST_F(DaemonTest, APathThatCannotBeWrittenIsToldAtTheStart) {
  const Hub hub(folder_);
  const Finished result =
      cairnd({"--lcm-url", hub.url(), "--map", (folder_ / "no/folder/a.cairn").string()});
  EXPECT_EQ(result.status, 73);
  EXPECT_THAT(result.errors, HasSubstr("there is no folder"));
}

TEST_F(DaemonTest, ABusThatIsNotThereIsToldWithWhatToDo) {
  const Finished result = cairnd({"--lcm-url", "tcpq://127.0.0.1:1", "--map", map()});
  EXPECT_EQ(result.status, 69);
  EXPECT_FALSE(result.errors.empty());
}

/// A daemon on a hub, and a client of the test's own beside it.
class RunningDaemonTest : public DaemonTest {
 protected:
  RunningDaemonTest()
      : hub_(folder_), daemon_({CAIRND, "--lcm-url", hub_.url(), "--map", map()}, folder_) {
    auto bus = wire::Bus::open(hub_.url());
    EXPECT_TRUE(bus.ok());
    bus_ = *std::move(bus);
    EXPECT_TRUE(bus_->subscribe("CAIRN_STATUS", 64, [this](const wire::Received& received) {
      if (const auto status =
              wire::decode<cairn_lcm::status_t>(received.bytes, received.size, 4096)) {
        status_ = *status;
        ++statuses_;
      }
    }));
    EXPECT_TRUE(bus_->subscribe("CAIRN_POSE", 64, [this](const wire::Received&) { ++poses_; }));
    EXPECT_TRUE(heard([this] { return statuses_ > 0; })) << daemon_.errors();
  }

  template <typename Condition>
  bool heard(const Condition& holds) {
    return eventually([&] {
      bus_->handle(50);
      return holds();
    });
  }

  static cairn_lcm::laser_scan_t room_scan(std::int64_t utime) {
    cairn_lcm::laser_scan_t scan{};
    scan.utime = utime;
    scan.first_bearing_rad = -1.57;
    scan.bearing_step_rad = 0.0174;
    scan.max_range_m = 10.0;
    scan.ranges_m.assign(180, 3.0F);
    scan.num_ranges = 180;
    return scan;
  }
  void publish_sound_scan() {
    const std::int64_t utime = now_utime();
    cairn_lcm::odometry_t odometry{};
    odometry.utime = utime;
    bus_->publish("ODOMETRY", odometry);
    bus_->publish("LASER", room_scan(utime));
  }

  Hub hub_;
  Process daemon_;
  std::unique_ptr<wire::Bus> bus_;
  cairn_lcm::status_t status_{};
  int statuses_ = 0;
  int poses_ = 0;
};

TEST_F(RunningDaemonTest, SaysThatItWaitsAndStopsCleanlyOnSigterm) {
  EXPECT_EQ(status_.state_name, "WAITING_FOR_SENSORS");
  daemon_.send(SIGTERM);
  const Finished result = daemon_.wait(std::chrono::seconds(5));
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(run({CAIRN, "status", map()}, folder_).status, 0);
}

TEST_F(RunningDaemonTest, MapsWhatItHears) {
  EXPECT_TRUE(heard([this] {
    publish_sound_scan();
    return poses_ > 3;
  }));
  EXPECT_TRUE(heard([this] { return status_.scans_mapped > 3; }));
  EXPECT_EQ(status_.scans_dropped, 0);
  EXPECT_EQ(status_.localisation_name, "tracking") << status_.localisation_reason;
  EXPECT_EQ(status_.is_using_odometry, 1);
}

TEST_F(RunningDaemonTest, CountsHostileMessagesAndGoesOn) {
  cairn_lcm::laser_scan_t scan = room_scan(now_utime());
  wire::Bytes hostile = wire::encode(scan);
  hostile[8 + 8 + 32] = 0x7F;  // The count of ranges: two thousand million.
  bus_->publish("LASER", hostile);
  bus_->publish("LASER", wire::Bytes{0xDE, 0xAD});
  bus_->publish("LASER", wire::Bytes(64, 0x11));  // A type nobody knows.
  scan.ranges_m.clear();
  scan.num_ranges = 0;
  bus_->publish("LASER", scan);                                    // Zero beams.
  bus_->publish("LASER", room_scan(now_utime() + 3'600'000'000));  // Far ahead of the clock.
  bus_->publish("CAIRN_REQUEST_PLAN", wire::Bytes{1, 2, 3});

  EXPECT_TRUE(heard([this] { return status_.decode_errors >= 3; }));
  EXPECT_TRUE(heard([this] { return status_.unknown_types >= 1 && status_.scans_refused >= 2; }));
  EXPECT_EQ(status_.scans_received, 0);
  EXPECT_TRUE(heard([this] {
    publish_sound_scan();
    return poses_ > 0;
  }));
}

TEST_F(RunningDaemonTest, NoticesAnotherDaemonOnTheBus) {
  Process second({CAIRND, "--lcm-url", hub_.url(), "--map", (folder_ / "b.cairn").string()},
                 folder_);
  EXPECT_TRUE(heard([this] { return status_.foreign_daemons > 0; }));
  EXPECT_TRUE(
      eventually([this] { return daemon_.errors().find("another cairnd") != std::string::npos; }));
}

TEST_F(RunningDaemonTest, AnswersAPlanItCannotMakeWithTheReason) {
  const Finished result =
      run({CAIRN, "path", "--to", "3", "--lcm-url", hub_.url(), "--timeout", "10"}, folder_);
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.status, 69) << result.errors;
}

}  // namespace
}  // namespace cairn::test
