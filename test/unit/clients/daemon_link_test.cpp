#include "clients/common/daemon_link.hpp"

#include <functional>
#include <memory>

#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/common/subscribe.hpp"
#include "unit/clients/sample_map.hpp"
#include "wire/document.hpp"
#include "wire/replication_server.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::plan_request_t;
using cairn_lcm::plan_t;
using cairn_lcm::result_t;
using cairn_lcm::snapshot_request_t;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The daemon's side of the bus, on the same thread as the client under test.
class FakeDaemon {
 public:
  explicit FakeDaemon(wire::Bus& bus)
      : bus_(bus),
        server_(
            99,
            [this](const cairn_lcm::snapshot_chunk_t& chunk) {
              if (++chunks_sent_ % lose_every_ != 0) {
                bus_.publish("CAIRN_SNAPSHOT", chunk);
              }
            },
            [](const cairn_lcm::map_delta_t&) {},
            small_chunks()) {
    serve(snapshot_request_t::TOPOLOGY, sample_topology());
    serve(snapshot_request_t::HYPOTHESES, sample_hypotheses());
    serve(snapshot_request_t::GLOBAL_MAP, sample_grid());
    subscribe<snapshot_request_t>(
        bus, "CAIRN_REQUEST_SNAPSHOT", [this](const snapshot_request_t& request) {
          if (!server_.on_request(steady_us(), request)) {
            refuse(request.header, result_t::NOT_FOUND, "nothing mapped yet");
          }
        });
    subscribe<plan_request_t>(bus, "CAIRN_REQUEST_PLAN", [this](const plan_request_t& request) {
      ++plan_requests_;
      if (answer_plan) {
        answer_plan(request);
      }
    });
  }

  void work() {
    bus_.publish("CAIRN_STATUS", sample_status());
    server_.pump(steady_us(), now_utime());
  }

  void refuse(const cairn_lcm::rpc_header_t& header, std::int32_t code, const char* reason) {
    result_t result{};
    result.header = header;
    result.code = code;
    result.reason = reason;
    bus_.publish("CAIRN_RESULT", result);
  }

  void send_plan(const plan_request_t& request, std::int32_t code) {
    plan_t plan{};
    plan.result.header = request.header;
    plan.result.code = code;
    plan.result.retry_after_ms = 10;
    plan.places = {1, 2, request.goal_place};
    plan.num_places = 3;
    bus_.publish("CAIRN_PLAN", plan);
  }

  std::function<void(const plan_request_t&)> answer_plan;
  int plan_requests_ = 0;
  int lose_every_ = 1'000'000;

 private:
  static wire::ReplicationServerOptions small_chunks() {
    wire::ReplicationServerOptions options;
    options.chunk_bytes = 256;
    return options;
  }

  template <typename Message>
  void serve(std::int32_t what, const Message& message) {
    server_.serve(what, [message] {
      return wire::Document{message.map_id, message.revision, wire::to_document(message)};
    });
  }

  wire::Bus& bus_;
  int chunks_sent_ = 0;
  wire::ReplicationServer server_;
};

class DaemonLinkTest : public ::testing::Test {
 protected:
  std::unique_ptr<wire::Bus> bus_ = std::move(*wire::Bus::open("memq://"));
  FakeDaemon daemon_{*bus_};
  DaemonLink link_{LinkOptions{.lcm_url = "memq://", .timeout_s = 3.0}, *bus_,
                   [this] { daemon_.work(); }};
};

TEST_F(DaemonLinkTest, DocumentsArriveWhole) {
  const cairn_lcm::grid_map_t grid = link_.global_map();

  EXPECT_EQ(wire::encode(grid), wire::encode(sample_grid()));
  EXPECT_EQ(wire::encode(link_.topology()), wire::encode(sample_topology()));
  EXPECT_EQ(wire::encode(link_.hypotheses()), wire::encode(sample_hypotheses()));
}

TEST_F(DaemonLinkTest, LostChunksAreAskedForAgain) {
  daemon_.lose_every_ = 3;

  EXPECT_EQ(wire::encode(link_.global_map()), wire::encode(sample_grid()));
}

TEST_F(DaemonLinkTest, WhatTheDaemonDoesNotHaveIsSaidAtOnce) {
  try {
    (void)link_.trajectory();
    FAIL() << "there is no trajectory";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kBadData);
    EXPECT_THAT(failure.what(), HasSubstr("no trajectory: nothing mapped yet"));
  }
}

TEST_F(DaemonLinkTest, StatusIsTheNextHeartbeat) {
  EXPECT_EQ(link_.status().scans_received, 1234);
}

TEST_F(DaemonLinkTest, APlanRequestIsRepeatedUntilItIsAnswered) {
  daemon_.answer_plan = [this](const plan_request_t& request) {
    if (daemon_.plan_requests_ == 3) {
      daemon_.send_plan(request, result_t::OK);
    }
  };
  plan_request_t request{};
  request.goal_place = 5;

  EXPECT_THAT(link_.plan(request).places, ElementsAre(1, 2, 5));
  EXPECT_EQ(daemon_.plan_requests_, 3);
}

TEST_F(DaemonLinkTest, ABusyDaemonIsAskedAgainAndARefusalEndsIt) {
  daemon_.answer_plan = [this](const plan_request_t& request) {
    if (daemon_.plan_requests_ < 3) {
      daemon_.send_plan(request, result_t::BUSY);
    } else {
      daemon_.refuse(request.header, result_t::NOT_FOUND, "no place 12");
    }
  };

  const plan_t plan = link_.plan({});

  EXPECT_EQ(plan.result.code, result_t::NOT_FOUND);
  EXPECT_EQ(plan.result.reason, "no place 12");
}

TEST_F(DaemonLinkTest, AnswersToOtherClientsAreNotOurs) {
  daemon_.answer_plan = [this](const plan_request_t& request) {
    plan_request_t of_another = request;
    of_another.header.client_id ^= 1;
    daemon_.send_plan(of_another, result_t::FAILED);
    daemon_.send_plan(request, result_t::OK);
  };

  EXPECT_EQ(link_.plan({}).result.code, result_t::OK);
}

TEST(DaemonLinkAlone, SaysWhatToDoWhenNobodyAnswers) {
  DaemonLink link(LinkOptions{.lcm_url = "memq://", .timeout_s = 0.1});
  for (const auto& ask : std::vector<std::function<void()>>{[&] { (void)link.status(); },
                                                            [&] { (void)link.topology(); },
                                                            [&] { (void)link.plan({}); }}) {
    try {
      ask();
      FAIL() << "there is no daemon";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kNoService);
      EXPECT_THAT(failure.what(), HasSubstr("no daemon answered on memq://"));
    }
  }
}

TEST(DaemonLinkAlone, ABusThatCannotBeOpenedIsAConfigurationError) {
  try {
    DaemonLink link(LinkOptions{.lcm_url = "nonsense://", .timeout_s = 0.1});
    FAIL() << "there is no such transport";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kConfiguration);
  }
}

}  // namespace
}  // namespace cairn::clients
