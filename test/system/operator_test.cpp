// An operator against the map: two visits that the map took for one place are told apart, the map
// obeys; taken back, it is what it was. Nothing that was acknowledged is lost by kill -9.

#include <algorithm>
#include <csignal>
#include <memory>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace cairn::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class OperatorTest : public ::testing::Test {
 protected:
  void drive_the_tour() {
    ASSERT_EQ(run({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/square.txt", "--tour", "twice",
                   "--log", log()},
                  folder_)
                  .status,
              0);
    ASSERT_EQ(run({CAIRND, "--replay", log(), "--map", map()}, folder_).status, 0);
  }

  [[nodiscard]] std::string log() const { return (folder_ / "tour.log").string(); }
  [[nodiscard]] std::string map() const { return (folder_ / "a.cairn").string(); }

  Finished cairn(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), CAIRN);
    arguments.insert(arguments.end(), {"--lcm-url", hub_.url(), "--timeout", "10"});
    return run(arguments, folder_);
  }
  json asked(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    return json::parse(cairn(std::move(arguments)).output, nullptr, false);
  }
  std::unique_ptr<Process> daemon() {
    auto process = std::make_unique<Process>(
        std::vector<std::string>{CAIRND, "--lcm-url", hub_.url(), "--map", map()}, folder_);
    EXPECT_TRUE(eventually([&] { return asked({"places"}).is_object(); })) << process->errors();
    return process;
  }
  int status_number(const char* key) {
    const json status = asked({"status"});
    return status.is_object() ? status.value(key, 0) : 0;
  }
  /// The map without what tells one run of the daemon, or one hypothesis number, from another.
  json places() {
    json document = asked({"places"});
    for (const char* key : {"utime", "boot_id", "revision", "hypothesis_id"}) {
      document.erase(key);
    }
    return document;
  }
  /// Place of each visit.
  std::vector<int> visits() {
    std::vector<int> places;
    const json overview = asked({"why"});
    for (const json& step : overview["steps"]) {
      places.push_back(step["at_place"]);
    }
    return places;
  }

  TemporaryFolder folder_;
  Hub hub_{folder_};
};

TEST_F(OperatorTest, TellsApartWhatTheMapMergedAndTakesItBack) {
  drive_the_tour();
  std::unique_ptr<Process> process = daemon();
  const json merged = places();
  const std::vector<int> before = visits();
  std::size_t first = 0;
  std::size_t second = 0;
  for (std::size_t b = 0; b < before.size() && second == 0; ++b) {
    const auto a =
        std::find(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(b), before[b]);
    if (a != before.begin() + static_cast<std::ptrdiff_t>(b)) {
      first = static_cast<std::size_t>(a - before.begin());
      second = b;
    }
  }
  ASSERT_GT(second, 0U) << "the tour closes a loop";
  const std::string one = "visit:" + std::to_string(first);
  const std::string other = "visit:" + std::to_string(second);

  const json report = asked({"different", one, other, "--who", "alice"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["assertion"], 1);
  EXPECT_GT(report["num_moved"].get<int>(), 0);
  const std::vector<int> apart = visits();
  EXPECT_NE(apart[first], apart[second]);
  const json obeyed = places();
  EXPECT_NE(obeyed, merged);
  const Finished contrary = cairn({"same", one, other});
  EXPECT_EQ(contrary.status, 65);
  EXPECT_THAT(contrary.errors, HasSubstr("contradicts assertion 1"));
  EXPECT_THAT(cairn({"why", std::to_string(second)}).output, HasSubstr("operator"));

  process->send(SIGKILL);
  static_cast<void>(process->wait());
  const json filed = json::parse(run({CAIRN, "assertions", "--json", map()}, folder_).output);
  EXPECT_EQ(filed["assertions"][0]["who"], "alice");
  EXPECT_EQ(filed["assertions"][0]["is_in_force"], true);
  process = daemon();
  EXPECT_EQ(places(), obeyed);
  EXPECT_EQ(asked({"assertions"})["assertions"][0]["effect"], report["sentence"]);

  EXPECT_EQ(cairn({"retract", "1", "--who", "bob"}).status, 0);
  EXPECT_EQ(cairn({"retract", "1"}).status, 65);
  EXPECT_EQ(visits(), before);
  EXPECT_EQ(places()["places"], merged["places"]);
  const Finished audit = cairn({"assertions"});
  EXPECT_THAT(audit.output, HasSubstr("taken back by bob"));

  process->send(SIGTERM);
  EXPECT_EQ(process->wait(std::chrono::seconds(20)).status, 0);
  process = daemon();
  EXPECT_EQ(cairn({"assertions"}).output, audit.output);
  EXPECT_EQ(visits(), before);
}

/// Scans and visits come before and after the assertion, and all of it is taken up in its order.
TEST_F(OperatorTest, GoesOnAlikeAfterAnAssertionInTheMiddleOfATour) {
  std::unique_ptr<Process> process = daemon();
  Process sim({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/square.txt", "--tour", "loop", "--speed",
               "10", "--lcm-url", hub_.url()},
              folder_);
  ASSERT_TRUE(eventually([&] { return status_number("num_visits") >= 3; }));
  EXPECT_EQ(cairn({"different", "visit:0", "visit:2"}).status, 0);
  EXPECT_EQ(cairn({"same", "visit:0", "visit:1"}).status, 0);
  EXPECT_EQ(cairn({"retract", "2"}).status, 0);
  EXPECT_EQ(sim.wait().status, 0) << sim.errors();
  // The input has paused for long enough that the last visit is closed.
  ASSERT_TRUE(eventually([&] { return status_number("scan_age_ms") > 7000; }));
  const auto known = [this] {
    json all = {{"places", asked({"places"})},
                {"hypotheses", asked({"hypotheses"})},
                {"assertions", asked({"assertions"})}};
    for (json& document : all) {
      document.erase("boot_id");
      document.erase("utime");
    }
    return all;
  };
  const json before = known();
  EXPECT_EQ(before["assertions"]["assertions"].size(), 2U);
  EXPECT_GT(before["hypotheses"]["num_visits"].get<int>(), 3);

  process->send(SIGKILL);
  static_cast<void>(process->wait());
  process = daemon();
  EXPECT_EQ(known(), before);
}

TEST_F(OperatorTest, IsToldWhatCannotBe) {
  drive_the_tour();
  const std::unique_ptr<Process> process = daemon();
  EXPECT_EQ(cairn({"same", "0", "99"}).status, 65);
  EXPECT_EQ(cairn({"same", "0", "attic"}).status, 65);
  EXPECT_EQ(cairn({"different", "0", "0"}).status, 65);
  EXPECT_EQ(cairn({"different", "0", "-1"}).status, 64);
  EXPECT_EQ(cairn({"retract", "1"}).status, 65);
  EXPECT_EQ(cairn({"why", "9999"}).status, 65);
  EXPECT_EQ(cairn({"why", "--hypotheses", "0", "987654"}).status, 65);
  EXPECT_THAT(cairn({"assertions"}).output, HasSubstr("nothing was ever asserted"));
}

}  // namespace
}  // namespace cairn::test
