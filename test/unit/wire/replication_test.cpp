#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <cairn_lcm/topology_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/wire/replication_simulation.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

using test::kMap;
using test::kMillisecond;
using test::kSecond;
using test::kTopology;
using test::LossyBus;
using test::random_tile;
using test::Simulation;

/// Two seconds of a growing map, with a client from the start and one that comes late.
double seconds_to_agree(unsigned seed, double loss, bool with_restart) {
  Simulation simulation(seed, loss);
  simulation.add_client();
  simulation.run(2 * kSecond, [&](std::int64_t t) {
    if (t % (20 * kMillisecond) == 0) {
      simulation.change_tiles(3, 8);
    }
    if (t == kSecond) {
      simulation.add_client();
    }
    if (with_restart && t == 1500 * kMillisecond) {
      simulation.start_server();
    }
  });
  return simulation.seconds_to_convergence(120.0);
}

TEST(Replication, EveryClientEndsWithTheSameMapWhateverIsLost) {
  for (const double loss : {0.0, 0.05, 0.2, 0.4}) {
    double worst_s = 0.0;
    for (unsigned seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " loss " << loss);
      const double seconds = seconds_to_agree(seed, loss, false);
      ASSERT_GE(seconds, 0.0);
      worst_s = std::max(worst_s, seconds);
    }
    RecordProperty("worst_s_at_" + std::to_string(loss), std::to_string(worst_s));
  }
}

TEST(Replication, ARestartOfTheDaemonIsFollowed) {
  for (const double loss : {0.0, 0.2, 0.4}) {
    for (unsigned seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " loss " << loss);
      ASSERT_GE(seconds_to_agree(seed, loss, true), 0.0);
    }
  }
}

TEST(Replication, AMapOfFiveMegabytesArrivesWhole) {
  for (const double loss : {0.0, 0.05, 0.2}) {
    Simulation simulation(3, loss);
    std::map<TileIndex, TileCells> tiles;
    for (std::int32_t i = 0; i < 20'000; ++i) {
      tiles[{i % 200, i / 200}] = random_tile(simulation.bus().random(), Simulation::kSide);
    }
    simulation.server().change(simulation.bus().now_us(), 0, kMap,
                               {7, 0.05, Simulation::kSide, tiles});
    simulation.add_client();
    const double seconds = simulation.seconds_to_convergence(60.0);
    ASSERT_GE(seconds, 0.6) << "faster than the pace allows";
    EXPECT_LT(seconds, 10.0);
    RecordProperty("seconds_at_" + std::to_string(loss), std::to_string(seconds));
    RecordProperty("bytes_at_" + std::to_string(loss), std::to_string(simulation.bytes_sent()));
  }
}

TEST(Replication, ARedrawnMapTravelsBySnapshot) {
  Simulation simulation(1, 0.0);
  simulation.add_client();
  simulation.change_tiles(20, 8);
  ASSERT_GE(simulation.seconds_to_convergence(2.0), 0.0);
  const int deltas_before = simulation.deltas_sent();
  simulation.change_tiles(1000, 100);
  EXPECT_GE(simulation.seconds_to_convergence(1.0), 0.0) << "without waiting for a status";
  EXPECT_LE(simulation.deltas_sent() - deltas_before, 2);
}

TEST(Replication, ATileThatIsAsBeforeIsNotSentAgain) {
  Simulation simulation(1, 0.0);
  simulation.add_client();
  const GridChange change{kMap, 0.1, 4, {{{1, 1}, random_tile(simulation.bus().random(), 4)}}};
  simulation.server().change(simulation.bus().now_us(), 0, kMap, change);
  ASSERT_GE(simulation.seconds_to_convergence(2.0), 0.0);
  const std::int64_t sent = simulation.deltas_sent();
  const std::int64_t revision = simulation.server().revision(kMap);
  GridChange same = change;
  same.tiles.begin()->second = std::make_shared<const Bytes>(*change.tiles.begin()->second);
  simulation.server().change(simulation.bus().now_us(), 0, kMap, same);
  simulation.run(100 * kMillisecond);
  EXPECT_EQ(simulation.deltas_sent(), sent);
  EXPECT_EQ(simulation.server().revision(kMap), revision);
}

TEST(Replication, ALostLastDeltaIsNoticed) {
  Simulation simulation(1, 0.0);
  simulation.add_client();
  simulation.change_tiles(20, 8);
  ASSERT_GE(simulation.seconds_to_convergence(2.0), 0.0);
  LossyBus& bus = simulation.bus();
  bus.cut();
  simulation.change_tiles(1, 8);
  simulation.run(100 * kMillisecond);
  EXPECT_FALSE(simulation.is_converged());
  bus.heal();
  EXPECT_GE(simulation.seconds_to_convergence(3.0), 0.0);
}

TEST(Replication, ClientsThatAskTogetherShareOneSnapshot) {
  Simulation simulation(1, 0.0);
  simulation.change_tiles(100, 40);
  simulation.run(2 * kSecond);
  const std::int64_t before = simulation.bytes_sent();
  for (int i = 0; i < 10; ++i) {
    simulation.add_client();
  }
  ASSERT_GE(simulation.seconds_to_convergence(2.0), 0.0);
  EXPECT_LT(simulation.bytes_sent() - before, 2 * 100 * 16 * 16 + 10'000);
}

TEST(Replication, AnotherMapStartsTheGridAfresh) {
  Simulation simulation(1, 0.1);
  simulation.add_client();
  simulation.change_tiles(20, 8);
  ASSERT_GE(simulation.seconds_to_convergence(20.0), 0.0);
  simulation.server().change(simulation.bus().now_us(), 0, kMap,
                             {8, 0.1, 4, {{{1, 1}, random_tile(simulation.bus().random(), 4)}}});
  ASSERT_GE(simulation.seconds_to_convergence(20.0), 0.0);
  EXPECT_EQ(simulation.client(0).mirror.grid().map_id, 8);
  EXPECT_EQ(simulation.client(0).mirror.grid().tiles.size(), 1U);
}

TEST(Replication, ASnapshotThatDeltasHaveOvertakenIsNotAskedForAnyMore) {
  std::vector<cairn_lcm::snapshot_chunk_t> chunks;
  std::vector<cairn_lcm::map_delta_t> deltas;
  ReplicationServerOptions options;
  options.chunk_bytes = 400;
  ReplicationServer server(
      9, [&](const auto& chunk) { chunks.push_back(chunk); },
      [&](const auto& delta) { deltas.push_back(delta); }, options);
  std::mt19937 random(1);
  auto pump_a_second = [&server, now_us = std::int64_t{0}]() mutable {
    for (int i = 0; i < 500; ++i) {
      server.pump(now_us += 2 * kMillisecond, 0);
    }
  };
  int snapshot_requests = 0;
  int delta_requests = 0;
  const ReplicationRequests ask{1, [&](const auto&) { ++snapshot_requests; },
                                [&](const auto&) { ++delta_requests; }};
  GridMirror mirror(kMap, ask);
  const auto change = [&](std::int32_t x) {
    server.change(0, 0, kMap, {7, 0.05, 16, {{{x, 0}, random_tile(random, 16)}}});
  };

  change(0);
  server.on_request(0, cairn_lcm::snapshot_request_t{});
  pump_a_second();
  for (const auto& chunk : chunks) {
    mirror.on_chunk(0, chunk);
  }
  ASSERT_EQ(mirror.grid().revision, 1);
  chunks.clear();
  deltas.clear();

  change(1);
  change(2);
  server.on_request(2 * kSecond, cairn_lcm::snapshot_request_t{});
  pump_a_second();
  ASSERT_GT(chunks.size(), 1U);
  mirror.on_chunk(0, chunks.front());  // The rest is lost; the deltas are not.
  for (const auto& delta : deltas) {
    mirror.on_delta(delta);
  }
  EXPECT_EQ(mirror.grid().revision, 3);
  mirror.on_chunk(0, chunks.back());
  mirror.on_status(9, 4);  // Behind again: of the old snapshot, nothing more may be asked for.
  for (std::int64_t t = 0; t < 10 * kSecond; t += 50 * kMillisecond) {
    mirror.tick(t, 0);
  }
  EXPECT_EQ(snapshot_requests, 0);
  EXPECT_GT(delta_requests, 0);
}

TEST(Replication, DocumentsAreFetchedThroughLoss) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Simulation simulation(seed, 0.3);
    cairn_lcm::topology_t topology{};
    topology.places.resize(500);
    topology.num_places = 500;
    simulation.server().serve(kTopology, [&]() -> std::optional<Document> {
      return Document{7, 12, encode(topology)};
    });
    simulation.add_client();
    simulation.is_fetching = true;
    simulation.run(30 * kSecond);
    ASSERT_EQ(simulation.client(0).fetch.state(), DocumentFetch::State::kDone);
    EXPECT_EQ(simulation.client(0).fetch.document(), encode(topology));
    EXPECT_EQ(simulation.client(0).fetch.revision(), 12);
  }
}

TEST(Replication, AFetchThatNobodyAnswersFails) {
  Simulation simulation(1, 1.0);
  simulation.add_client();
  simulation.is_fetching = true;
  simulation.run(20 * kSecond);
  EXPECT_EQ(simulation.client(0).fetch.state(), DocumentFetch::State::kFailed);
}

TEST(Replication, ThePaceIsKept) {
  Simulation simulation(1, 0.0);
  simulation.change_tiles(5000, 1000);
  for (int i = 0; i < 3; ++i) {
    simulation.add_client();
  }
  const std::int64_t before = simulation.bytes_sent();
  simulation.run(200 * kMillisecond);
  EXPECT_LE(simulation.bytes_sent() - before, 8'000'000 / 5 + 3 * 16'000);
}

TEST(BootFilter, DoesNotGoBackToARunThatHasEnded) {
  BootFilter filter;
  EXPECT_EQ(filter.hear(5), BootFilter::Verdict::kRestarted);
  EXPECT_EQ(filter.hear(5), BootFilter::Verdict::kSame);
  EXPECT_EQ(filter.hear(6), BootFilter::Verdict::kRestarted);
  EXPECT_EQ(filter.hear(5), BootFilter::Verdict::kStale);
  EXPECT_EQ(filter.hear(0), BootFilter::Verdict::kStale);
}

}  // namespace
}  // namespace cairn::wire
