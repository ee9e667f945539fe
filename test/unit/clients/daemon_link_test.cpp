#include "clients/common/daemon_link.hpp"

#include <functional>
#include <memory>

#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/clients/fake_daemon.hpp"
#include "unit/clients/sample_map.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::plan_request_t;
using cairn_lcm::plan_t;
using cairn_lcm::result_t;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
