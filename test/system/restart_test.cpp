// What is journalled survives: a daemon that is ended in the middle of a tour goes on from its map
// file with the same places, hypotheses and frame.

#include <csignal>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace cairn::test {
namespace {

using nlohmann::json;

class RestartTest : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] std::string map() const { return (folder_ / "a.cairn").string(); }
  json asked(const std::string& what, const std::string& url) {
    const Finished result =
        run({CAIRN, what, "--json", "--lcm-url", url, "--timeout", "10"}, folder_);
    return json::parse(result.output, nullptr, false);
  }

  TemporaryFolder folder_;
};

TEST_P(RestartTest, GoesOnWithTheSamePlacesHypothesesAndFrame) {
  const Hub hub(folder_);
  json places_before;
  json hypotheses_before;
  {
    Process daemon({CAIRND, "--lcm-url", hub.url(), "--map", map()}, folder_);
    ASSERT_TRUE(eventually([&] { return asked("status", hub.url()).is_object(); }));
    const Finished sim = run({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/square.txt", "--tour",
                              "loop", "--speed", "20", "--lcm-url", hub.url()},
                             folder_);
    ASSERT_EQ(sim.status, 0) << sim.errors;
    ASSERT_TRUE(eventually([&] {
      const json status = asked("status", hub.url());
      // The input has paused for long enough that the last visit is closed.
      return status.is_object() && status.value("scans_received", 0) > 0 &&
             status.value("scan_age_ms", 0) > 7000;
    }));
    EXPECT_EQ(run({CAIRN, "name", "1", "kitchen", "--lcm-url", hub.url()}, folder_).status, 0);
    EXPECT_EQ(run({CAIRN, "name", "2", "kitchen", "--lcm-url", hub.url()}, folder_).status, 65);
    EXPECT_EQ(run({CAIRN, "name", "99", "attic", "--lcm-url", hub.url()}, folder_).status, 65);
    places_before = asked("places", hub.url());
    EXPECT_EQ(places_before["places"][1]["name"], "kitchen");
    hypotheses_before = asked("hypotheses", hub.url());
    daemon.send(GetParam());
    static_cast<void>(daemon.wait(std::chrono::seconds(10)));
  }
  ASSERT_TRUE(places_before.is_object() || places_before.is_array());

  Process daemon({CAIRND, "--lcm-url", hub.url(), "--map", map()}, folder_);
  ASSERT_TRUE(eventually([&] { return asked("status", hub.url()).is_object(); }))
      << daemon.errors();
  for (json* document : {&places_before, &hypotheses_before}) {
    document->erase("boot_id");
    document->erase("utime");
  }
  json places_after = asked("places", hub.url());
  json hypotheses_after = asked("hypotheses", hub.url());
  for (json* document : {&places_after, &hypotheses_after}) {
    document->erase("boot_id");
    document->erase("utime");
  }
  EXPECT_EQ(places_after, places_before);
  EXPECT_EQ(hypotheses_after, hypotheses_before);
}

/// The journal may be cut anywhere: what is taken up again is what the journal holds, or has been
/// added to it, so that another restart finds the same.
TEST(RestartAnywhereTest, ASecondRestartFindsWhatTheFirstMadeKnown) {
  const TemporaryFolder folder;
  const std::string log = (folder / "tour.log").string();
  ASSERT_EQ(run({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/lattice.txt", "--tour", "complete",
                 "--log", log},
                folder)
                .status,
            0);
  const std::string bytes = content_of(log);
  const Hub hub(folder);
  for (int cut = 1; cut <= 5; ++cut) {
    SCOPED_TRACE(cut);
    const std::string part = (folder / "part.log").string();
    write_file(part, bytes.substr(0, bytes.size() * static_cast<std::size_t>(cut) / 6));
    const std::string map = (folder / ("cut" + std::to_string(cut))).string();
    static_cast<void>(run({CAIRND, "--replay", part, "--map", map}, folder));
    std::vector<json> found;
    for (int start = 0; start < 2; ++start) {
      Process daemon({CAIRND, "--lcm-url", hub.url(), "--map", map}, folder);
      const auto places = [&] {
        return json::parse(
            run({CAIRN, "places", "--json", "--lcm-url", hub.url(), "--timeout", "10"}, folder)
                .output,
            nullptr, false);
      };
      ASSERT_TRUE(eventually([&] { return places().is_object(); })) << daemon.errors();
      found.push_back(places());
      found.back().erase("boot_id");
      daemon.send(SIGKILL);
      static_cast<void>(daemon.wait());
    }
    EXPECT_EQ(found[0], found[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(After,
                         RestartTest,
                         ::testing::Values(SIGTERM, SIGKILL),
                         [](const ::testing::TestParamInfo<int>& signal) {
                           return signal.param == SIGTERM ? "Sigterm" : "Kill9";
                         });

}  // namespace
}  // namespace cairn::test
