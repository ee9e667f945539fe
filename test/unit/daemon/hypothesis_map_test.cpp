// The map of one hypothesis, from a client's request over the bus to its document, and what the
// best map notices of it: nothing.

#include <map>

#include <cairn_lcm/hypothesis_map_t.hpp>
#include <gmock/gmock.h>

#include "clients/common/daemon_link.hpp"
#include "clients/common/subscribe.hpp"
#include "runtime/hypothesis_drawer.hpp"
#include "runtime/publisher.hpp"
#include "service/refined_map.hpp"
#include "unit/daemon/operator_desk_fixture.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using cairn_lcm::hypothesis_map_t;
using cairn_lcm::result_t;
using cairn_lcm::snapshot_request_t;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// What the event loop does for these requests, one step at a time.
class LoopOfTheDaemon {
 public:
  LoopOfTheDaemon(wire::Bus& bus, std::unique_ptr<Engine> engine)
      : mapping_(std::move(engine), {}, wakeup_),
        drawer_({}, {}, wakeup_),
        publisher_(bus,
                   99,
                   {},
                   {[](const cairn_lcm::plan_request_t&) { return false; },
                    [this](MapRequest one) { mapping_.ask(std::move(one)); },
                    [this](const snapshot_request_t& one) {
                      ++ordered_;
                      mapping_.ask(one);
                    }}) {
    EXPECT_TRUE(publisher_.subscribe());
  }

  void work() {
    while (const std::optional<MappingReport> report = mapping_.next_report()) {
      publisher_.publish(*report);
      if (report->hypothesis && report->hypothesis->state) {
        drawer_.order({*report->hypothesis->state, publisher_.sender()});
      }
    }
    while (std::optional<HypothesisDrawing> drawing = drawer_.next_drawing()) {
      publisher_.publish(*std::move(drawing));
    }
    publisher_.publish(cairn_lcm::status_t{});
    publisher_.pump();
  }

  Wakeup wakeup_;
  MappingThread mapping_;
  HypothesisDrawer drawer_;
  Publisher publisher_;
  int ordered_ = 0;
};

class HypothesisMapTest : public test::OperatorDeskTest {
 protected:
  HypothesisMapTest() { open(); }

  /// What a client gets that asks for it.
  hypothesis_map_t asked(std::int64_t hypothesis) {
    if (loop_ == nullptr) {
      loop_ = std::make_unique<LoopOfTheDaemon>(*bus_, std::move(engine_));
    }
    clients::DaemonLink link({.lcm_url = "memq://", .timeout_s = 10.0}, *bus_,
                             [this] { loop_->work(); });
    return link.hypothesis_map(hypothesis);
  }
  /// @return the status with which the client ends, and what it says
  std::pair<clients::ExitCode, std::string> refusal(std::int64_t hypothesis) {
    try {
      static_cast<void>(asked(hypothesis));
    } catch (const clients::Failure& failure) {
      return {failure.code(), failure.what()};
    }
    ADD_FAILURE() << "hypothesis " << hypothesis << " was drawn";
    return {};
  }

  std::unique_ptr<wire::Bus> bus_ = std::move(*wire::Bus::open("memq://"));
  std::unique_ptr<LoopOfTheDaemon> loop_;
};

/// Without what tells one daemon from another.
template <typename Message>
wire::Bytes bytes_of(Message message) {
  message.boot_id = 0;
  return wire::encode(message);
}

TEST_F(HypothesisMapTest, OfTheBestHypothesisItIsTheBestMapTileForTile) {
  const std::int64_t map_id = engine_->map_id();
  const std::shared_ptr<const MapState> best = MapRefiner().refined(engine_->service().state());
  MapMaker maker({});
  maker.draw(*best);

  const hypothesis_map_t map = asked(best->hypothesis);

  EXPECT_EQ(map.hypothesis_id, best->hypothesis);
  EXPECT_EQ(bytes_of(map.topology), bytes_of(to_topology(*best, {0, map_id})));
  EXPECT_EQ(bytes_of(map.visits), bytes_of(to_visit_places(*best, {0, map_id})));
  EXPECT_EQ(wire::encode(map.trajectory), wire::encode(to_trajectory(*best, {0, map_id})));
  EXPECT_EQ(wire::encode(map.global_map), wire::encode(maker.grid_map({0, map_id})));
  EXPECT_THAT(map.global_map.tiles, Not(IsEmpty()));
}

TEST_F(HypothesisMapTest, EveryLiveOneIsDrawnWithItsOwnPlaces) {
  const std::shared_ptr<const MapState> best = engine_->service().state();
  ASSERT_GT(best->hypotheses.size(), 2U);
  for (std::size_t i = 0; i < 3; ++i) {
    const HypothesisSummary& one = best->hypotheses[i];
    const hypothesis_map_t map = asked(one.id);
    EXPECT_EQ(map.hypothesis_id, one.id);
    EXPECT_EQ(map.topology.hypothesis_id, one.id);
    EXPECT_EQ(map.topology.num_places, one.places);
    EXPECT_DOUBLE_EQ(map.topology.probability, one.probability);
    EXPECT_EQ(map.visits.num_visits, kVisits);
    EXPECT_EQ(map.trajectory.num_poses, static_cast<int>(best->poses.size()));
  }
}

TEST_F(HypothesisMapTest, TheBestMapIsNotPublishedAnewByIt) {
  std::map<std::string, int> heard;
  for (const char* const channel : {"CAIRN_TOPOLOGY", "CAIRN_HYPOTHESES", "CAIRN_MAP_DELTA",
                                    "CAIRN_FRAME_CHANGE", "CAIRN_PLACE_EVENT"}) {
    ASSERT_TRUE(bus_->subscribe(channel, 64,
                                [&heard, channel](const wire::Received&) { ++heard[channel]; }));
  }
  std::int64_t map_revision = -1;
  clients::subscribe<cairn_lcm::status_t>(
      *bus_, "CAIRN_STATUS",
      [&](const cairn_lcm::status_t& status) { map_revision = status.map_revision; });
  static_cast<void>(asked(hypotheses()[1]));
  EXPECT_THAT(heard, IsEmpty());
  EXPECT_EQ(map_revision, 0);
}

TEST_F(HypothesisMapTest, AnUnknownOneIsRefusedWithThoseThatAreLive) {
  const std::int64_t best = engine_->service().state()->hypothesis;
  const auto [code, message] = refusal(99'999);
  EXPECT_EQ(code, clients::ExitCode::kBadData);
  EXPECT_THAT(message, AllOf(HasSubstr("hypothesis 99999 is not live"),
                             HasSubstr("expected one of " + std::to_string(best))));
  // The next one is served.
  EXPECT_EQ(asked(best).hypothesis_id, best);
}

TEST_F(HypothesisMapTest, OneThatWasGivenUpBetweenListingAndAskingIsRefusedAlike) {
  const std::vector<std::int64_t> listed = hypotheses();
  ASSERT_EQ(say(cairn_lcm::assert_request_t::SAME, test::visit(0), test::visit(4)).result.code,
            result_t::OK);
  const std::vector<std::int64_t> live = hypotheses();
  const auto gone = std::find_if(listed.begin(), listed.end(), [&](std::int64_t one) {
    return std::find(live.begin(), live.end(), one) == live.end();
  });
  ASSERT_NE(gone, listed.end());
  const auto [code, message] = refusal(*gone);
  EXPECT_EQ(code, clients::ExitCode::kBadData);
  EXPECT_THAT(message, AllOf(HasSubstr("hypothesis " + std::to_string(*gone) + " is not live"),
                             HasSubstr("expected one of " + std::to_string(live.front()))));
}

/// A publisher whose orders are noted and not carried out.
class RequestsForHypothesisMaps : public ::testing::Test {
 protected:
  RequestsForHypothesisMaps() {
    EXPECT_TRUE(publisher_.subscribe());
    clients::subscribe<result_t>(*bus_, "CAIRN_RESULT",
                                 [this](const result_t& result) { results_.push_back(result); });
  }
  /// @return the answer's code
  std::int32_t ask(std::int64_t hypothesis) {
    snapshot_request_t request{};
    request.header.client_id = 7;
    request.header.request_id = ++requests_;
    request.what = snapshot_request_t::HYPOTHESIS_MAP;
    request.hypothesis_id = hypothesis;
    bus_->publish("CAIRN_REQUEST_SNAPSHOT", request);
    results_.clear();
    while (bus_->handle(0, 16) > 0) {
    }
    return results_.empty() ? -1 : results_.back().code;
  }
  void answer(std::int64_t hypothesis, Result<std::shared_ptr<const MapState>> state) {
    MappingReport report;
    snapshot_request_t request{};
    request.hypothesis_id = hypothesis;
    report.hypothesis = AskedHypothesis{request, std::move(state)};
    publisher_.publish(report);
  }

  std::unique_ptr<wire::Bus> bus_ = std::move(*wire::Bus::open("memq://"));
  std::vector<std::int64_t> ordered_;
  Publisher publisher_{*bus_, 99, {}, {{}, {}, [this](const snapshot_request_t& request) {
                                         ordered_.push_back(request.hypothesis_id);
                                       }}};
  std::vector<result_t> results_;
  std::int32_t requests_ = 0;
};

TEST_F(RequestsForHypothesisMaps, OneIsMadeAtATimeAndTheOthersAreToldSo) {
  EXPECT_EQ(ask(3), result_t::ACCEPTED);
  EXPECT_EQ(ask(8), result_t::BUSY);
  EXPECT_THAT(results_.back().reason, HasSubstr("hypothesis 3 is being drawn"));
  EXPECT_EQ(ask(3), result_t::ACCEPTED);
  answer(3, std::make_shared<const MapState>());
  EXPECT_EQ(ask(8), result_t::BUSY);
  EXPECT_THAT(ordered_, ElementsAre(3));

  publisher_.publish(HypothesisDrawing{3, {0, 1, wire::Bytes(10, 1)}});
  EXPECT_EQ(ask(3), -1);  // It is on its way.
  EXPECT_EQ(ask(8), result_t::ACCEPTED);
  EXPECT_THAT(ordered_, ElementsAre(3, 8));
}

TEST_F(RequestsForHypothesisMaps, ARefusedOneMakesRoomForTheNext) {
  EXPECT_EQ(ask(3), result_t::ACCEPTED);
  answer(3, Error{ErrorCode::kNotFound, "hypothesis 3 is not live"});
  EXPECT_EQ(ask(8), result_t::ACCEPTED);
  EXPECT_THAT(ordered_, ElementsAre(3, 8));
}

TEST_F(RequestsForHypothesisMaps, APieceOfOneAsksForNoOther) {
  publisher_.publish(HypothesisDrawing{3, {0, 1, wire::Bytes(10, 1)}});
  EXPECT_EQ(ask(3), -1);
  EXPECT_THAT(ordered_, IsEmpty());
}

}  // namespace
}  // namespace cairn
