#include <atomic>
#include <functional>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "clients/cairn/program.hpp"
#include "support/files.hpp"
#include "support/program_run.hpp"
#include "unit/clients/fake_daemon.hpp"
#include "wire/tcpq_hub.hpp"

namespace cairn::clients {
namespace {

using test::content_of;
using test::TemporaryFolder;
using Outcome = test::ProgramRun;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Calls something again and again on a thread of its own.
class Loop {
 public:
  explicit Loop(std::function<void()> work)
      : thread_([this, work = std::move(work)] {
          while (!stop_) {
            work();
          }
        }) {}
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  ~Loop() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The commands against a daemon on a bus of their own: a hub on a free port of this machine.
class LiveCommands : public ::testing::Test {
 protected:
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--lcm-url", hub_.url()});
    return test::run_program(run_cairn, arguments);
  }

  static wire::TcpqHubOptions on_a_free_port() {
    wire::TcpqHubOptions options;
    options.port = 0;
    return options;
  }

  void answer(const cairn_lcm::plan_request_t& request) {
    if (request.goal_name == "nowhere") {
      daemon_.refuse(request.header, cairn_lcm::result_t::NOT_FOUND, "no place has this name");
    } else {
      daemon_.send_plan(request, cairn_lcm::result_t::OK);
    }
  }

  wire::TcpqHub hub_ = *wire::TcpqHub::open(on_a_free_port());
  Loop hub_loop_{[this] { hub_.serve(5); }};
  std::unique_ptr<wire::Bus> bus_ = std::move(*wire::Bus::open(hub_.url()));
  FakeDaemon daemon_{*bus_};
  int rounds_ = 0;
  Loop daemon_loop_{[this] {
    if (rounds_ == 0) {
      daemon_.answer_plan = [this](const auto& request) { answer(request); };
    }
    if (++rounds_ % 10 == 0) {
      daemon_.happen();
    }
    daemon_.work();
    bus_->handle(5);
  }};
};

TEST_F(LiveCommands, ShowWhatTheDaemonHolds) {
  EXPECT_THAT(run({"status"}).out, AllOf(HasSubstr("MAPPING"), HasSubstr("5 in 9 visits"),
                                         HasSubstr("1234 received"), HasSubstr("none yet")));
  EXPECT_EQ(nlohmann::json::parse(run({"status", "--json"}).out)["boot_id"], 99);
  EXPECT_THAT(run({"places"}).out, HasSubstr("0>3 1>1 2?"));
  EXPECT_THAT(run({"hypotheses"}).out, HasSubstr("2 live after 9 visits, 17 waiting"));
}

TEST_F(LiveCommands, DrawTheSamePictureAsFromTheFile) {
  const TemporaryFolder folder;
  write_sample_map(folder / "m.cairn");
  const std::string live = (folder / "live.png").string();
  const std::string filed = (folder / "file.png").string();

  EXPECT_EQ(run({"map", "--png", live}).status, 0);
  EXPECT_EQ(run({"map", "--png", filed, (folder / "m.cairn").string()}).status, 0);

  EXPECT_EQ(content_of(live), content_of(filed));
}

TEST_F(LiveCommands, DrawTheSamePlacesAsFromTheFile) {
  const TemporaryFolder folder;
  write_sample_map(folder / "m.cairn");
  const std::string map = (folder / "m.cairn").string();

  const Outcome live = run({"places", "--all", "--png", (folder / "live").string()});
  EXPECT_EQ(live.status, 0) << live.err;
  EXPECT_EQ(run({"places", "--all", "--png", (folder / "file").string(), map}).status, 0);
  EXPECT_EQ(content_of(folder / "live" / "place-1-visit-5.png"),
            content_of(folder / "file" / "place-1-visit-5.png"));
  EXPECT_EQ(run({"map", "--places", "--png", (folder / "m.png").string()}).status, 0);
}

TEST_F(LiveCommands, ShowAnotherHypothesisThanTheBestWhereItIsAskedFor) {
  const TemporaryFolder folder;
  const std::string svg = (folder / "m.svg").string();
  const std::string pgm = (folder / "m.pgm").string();

  const Outcome map = run({"map", "--hypothesis", "8", "--svg", svg, "--pgm", pgm, "--png",
                           (folder / "m.png").string(), "--trajectory", "--places"});

  EXPECT_EQ(map.status, 0) << map.err;
  EXPECT_THAT(map.err, HasSubstr("hypothesis 8, probability 0.250"));
  EXPECT_THAT(content_of(svg), HasSubstr("annexe"));
  EXPECT_TRUE(std::filesystem::exists(folder / "m.yaml"));
  EXPECT_THAT(run({"places", "--hypothesis", "8"}).out, HasSubstr("annexe"));
  EXPECT_EQ(run({"export", "--hypothesis", "8", "--trajectory", (folder / "t").string()}).status,
            0);
  EXPECT_THAT(run({"places"}).out, Not(HasSubstr("annexe")));
}

TEST_F(LiveCommands, AHypothesisThatIsNotLiveIsBadDataAndNoNumberIsUsage) {
  const Outcome unknown = run({"map", "--hypothesis", "99", "--png", "/dev/null"});
  EXPECT_EQ(unknown.status, 65);
  EXPECT_THAT(unknown.err, HasSubstr("hypothesis 99 is not live; expected one of 3, 8"));

  const Outcome word = run({"map", "--hypothesis", "best", "--png", "/dev/null"});
  EXPECT_EQ(word.status, 64);
  EXPECT_THAT(word.err, HasSubstr("expected a whole number"));
  EXPECT_EQ(run({"map", "--hypothesis", "-1", "--png", "/dev/null"}).status, 64);
}

TEST_F(LiveCommands, ADaemonThatDrawsAnotherHypothesisIsWaitedForAndThenLeft) {
  daemon_.answer_to_others = cairn_lcm::result_t::BUSY;
  const Outcome busy = run({"map", "--hypothesis", "99", "--png", "/dev/null", "--timeout", "0.3"});
  EXPECT_EQ(busy.status, 69);
  EXPECT_THAT(busy.err, HasSubstr("the daemon is busy: "));
}

TEST_F(LiveCommands, ATrajectoryThatTheDaemonDoesNotHaveIsBadData) {
  const Outcome outcome = run({"export", "--trajectory", "/dev/null"});
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.err, HasSubstr("the daemon has no trajectory: nothing mapped yet"));
}

TEST_F(LiveCommands, PathIsAskedForAndPrinted) {
  const Outcome path = run({"path", "--to", "5"});
  EXPECT_EQ(path.status, 0) << path.err;
  EXPECT_THAT(path.out, HasSubstr("1 > 2 > 5"));

  const Outcome nowhere = run({"path", "--to", "nowhere"});
  EXPECT_EQ(nowhere.status, 65);
  EXPECT_THAT(nowhere.err, HasSubstr("no path: no place has this name"));
}

TEST_F(LiveCommands, AnAssertionSaysWhatChanged) {
  const Outcome done = run({"different", "3", "visit:9", "--who", "alice"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("assertion 3: visit 9 is at another place now"));
  EXPECT_THAT(done.out, HasSubstr("visit 9: place 6 (known since visit 9)"));
  EXPECT_EQ(daemon_.heard_.a.place, 3);
  EXPECT_EQ(daemon_.heard_.b.visit, 9);
  EXPECT_EQ(daemon_.heard_.who, "alice");
  EXPECT_GT(daemon_.asserts_heard_, 1) << "ACCEPTED is not the answer";

  const Outcome refused = run({"same", "kitchen", "5"});
  EXPECT_EQ(refused.status, 65);
  EXPECT_THAT(refused.err, HasSubstr("not asserted: it contradicts assertion 1"));
  EXPECT_EQ(run({"same", "visit:x", "5"}).status, 64);
  EXPECT_EQ(run({"same", "5"}).status, 64);
  EXPECT_THAT(run({"retract", "3"}).out, HasSubstr("assertion 3 taken back"));
}

TEST_F(LiveCommands, WhatIsTypedWrongIsSaidInAFewWords) {
  const std::string huge(309, '9');
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"why", "-1"}, "expected a whole number from 0 to 2147483647, got '-1'"},
      {{"why", "abc"}, "expected a whole number from 0 to 2147483647, got 'abc'"},
      {{"why", huge}, "expected a whole number from 0 to 2147483647, got '999"},
      {{"why", "--hypotheses", "3", "x"}, "expected a whole number from 0"},
      {{"retract", "0"}, "expected a whole number from 1"},
      {{"retract", huge}, "expected a whole number from 1"},
      {{"same", "1", "2", "--who", std::string(100'000, 'a')}, "--who: expected 1 to 64 bytes"},
      {{"same", "1", "2", "--who", "a\nb"}, "--who: expected 1 to 64 bytes"},
      {{"same", "1", std::string(100'000, 'a')}, "is no place: a name has at most 64 bytes"},
  };
  for (const auto& [arguments, message] : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 64) << message;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_LT(outcome.err.size(), 250U);
  }
}

TEST_F(LiveCommands, TheAuditTellsWhoSaidWhatAndWhen) {
  const Outcome audit = run({"assertions"});
  EXPECT_EQ(audit.status, 0) << audit.err;
  EXPECT_THAT(audit.out, HasSubstr("1  visit 2 (place 3) is the same place as visit 7 (place 3)"));
  EXPECT_THAT(audit.out, HasSubstr("taken back by bob, 2023-11-14T22:14:20Z, after 9 visits"));
  EXPECT_THAT(audit.out, HasSubstr("2  visit 2 (place 3) is another place than visit 7 (place 5)"));
}

TEST_F(LiveCommands, WhyAsksUntilAllVisitsAreExplained) {
  const nlohmann::json all = nlohmann::json::parse(run({"why", "--json"}).out);
  EXPECT_EQ(all["steps"].size(), 5U);
  const Outcome one = run({"why", "3"});
  EXPECT_THAT(one.out, HasSubstr("visit 3 is at place 2 of hypothesis 3"));
  EXPECT_THAT(run({"why", "--place", "2"}).out, HasSubstr("visit 3 is at place 2"));
  EXPECT_EQ(run({"why", "--place", "99"}).status, 65);
  EXPECT_EQ(run({"why", "--place", "attic"}).status, 65);
  EXPECT_THAT(run({"why", "--hypotheses", "3", "8"}).out, HasSubstr("part at visit 4"));
  EXPECT_EQ(run({"why", "3", "--place", "2"}).status, 64);
  const nlohmann::json fate = nlohmann::json::parse(run({"why", "3", "--json"}).out)["steps"][0];
  EXPECT_EQ(fate["fate"]["is_refuted"], true);
  EXPECT_TRUE(fate["fate"]["log_odds"].is_null());
}

TEST_F(LiveCommands, WatchAsksForTheEventsThatTheBusLost) {
  const Outcome watch = run({"watch", "--count", "5", "--json"});

  EXPECT_EQ(watch.status, 0) << watch.err;
  std::istringstream lines(watch.out);
  std::int64_t last = 0;
  int num_lines = 0;
  for (std::string line; std::getline(lines, line); ++num_lines) {
    const nlohmann::json json = nlohmann::json::parse(line);
    if (json["what"] == "event") {
      const auto number = json["message"]["event_number"].get<std::int64_t>();
      EXPECT_TRUE(last == 0 || number == last + 1) << number << " after " << last;
      last = number;
    }
  }
  EXPECT_EQ(num_lines, 5);
  EXPECT_GT(last, 0);
}

TEST_F(LiveCommands, WatchTellsThatTheMapHasMoved) {
  EXPECT_THAT(run({"watch", "--count", "9"}).out,
              HasSubstr("moved   map 6 to 7: 1 places, by 0.50 m at most; the robot by (0.25 m, "));
  std::istringstream lines(run({"watch", "--count", "9", "--json"}).out);
  bool is_told = false;
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json json = nlohmann::json::parse(line);
    if (json["what"] == "moved") {
      is_told = true;
      EXPECT_EQ(json["message"]["places"][0]["place_id"], 3);
      EXPECT_EQ(json["message"]["newer_revision"], 7);
    }
  }
  EXPECT_TRUE(is_told);
}

}  // namespace
}  // namespace cairn::clients
