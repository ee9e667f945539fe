#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <cairn_lcm/topology_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/document.hpp"
#include "wire/replication_client.hpp"
#include "wire/replication_server.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

constexpr std::int32_t kMap = cairn_lcm::map_delta_t::GLOBAL_MAP;
constexpr std::int32_t kTopology = cairn_lcm::snapshot_request_t::TOPOLOGY;
constexpr std::int64_t kMillisecond = 1'000;
constexpr std::int64_t kSecond = 1'000'000;

TileCells random_tile(std::mt19937& random, std::int32_t side) {
  Bytes cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::generate(cells.begin(), cells.end(),
                [&random] { return static_cast<std::uint8_t>(random()); });
  return std::make_shared<const Bytes>(std::move(cells));
}

/// A bus in virtual time that loses, doubles and reorders whatever is put on it.
class LossyBus {
 public:
  LossyBus(unsigned seed, double loss) : random_(seed), loss_(loss) {}

  void send(std::function<void()> deliver) {
    for (int copies = chance(0.02) ? 2 : 1; copies > 0; --copies) {
      if (!chance(loss_)) {
        const std::int64_t delay_us = chance(0.1) ? below(30'000) : below(500);
        in_flight_.emplace(now_us_ + delay_us, deliver);
      }
    }
  }
  void advance_to(std::int64_t now_us) {
    while (!in_flight_.empty() && in_flight_.begin()->first <= now_us) {
      const auto deliver = std::move(in_flight_.begin()->second);
      in_flight_.erase(in_flight_.begin());
      deliver();
    }
    now_us_ = now_us;
  }
  std::mt19937& random() { return random_; }
  [[nodiscard]] std::int64_t now_us() const { return now_us_; }
  void cut() { loss_ = 1.0; }
  void heal() { loss_ = 0.0; }

 private:
  bool chance(double probability) {
    return std::uniform_real_distribution<>(0.0, 1.0)(random_) < probability;
  }
  std::int64_t below(std::int64_t bound) {
    return std::uniform_int_distribution<std::int64_t>(0, bound)(random_);
  }

  std::mt19937 random_;
  double loss_;
  std::int64_t now_us_ = kSecond;
  std::multimap<std::int64_t, std::function<void()>> in_flight_;
};

/// One daemon and any number of clients on a lossy bus.
class Simulation {
 public:
  Simulation(unsigned seed, double loss) : bus_(seed, loss) { start_server(); }

  /// The daemon is killed and comes up again with an empty map.
  void start_server() {
    ++boot_id_;
    server_ = std::make_unique<ReplicationServer>(
        boot_id_,
        [this](const cairn_lcm::snapshot_chunk_t& chunk) {
          bytes_sent_ += chunk.num_bytes;
          to_all([chunk](Client& client, std::int64_t now_us) {
            client.mirror.on_chunk(now_us, chunk);
            client.fetch.on_chunk(now_us, chunk);
          });
        },
        [this](const cairn_lcm::map_delta_t& delta) {
          bytes_sent_ += delta.num_bytes;
          ++deltas_sent_;
          to_all([delta](Client& client, std::int64_t) { client.mirror.on_delta(delta); });
        });
    server_->change(bus_.now_us(), 0, kMap, {7, 0.05, kSide, {}});
  }

  std::size_t add_client() {
    const auto index = clients_.size();
    ReplicationRequests requests;
    requests.client_id = static_cast<std::int64_t>(index) + 100;
    requests.send_snapshot_request = [this](const cairn_lcm::snapshot_request_t& request) {
      ++requests_sent_;
      bus_.send([this, request] { server_->on_request(bus_.now_us(), request); });
    };
    requests.send_delta_request = [this](const cairn_lcm::delta_request_t& request) {
      ++requests_sent_;
      bus_.send([this, request] { server_->on_request(bus_.now_us(), request); });
    };
    clients_.push_back(std::make_unique<Client>(
        Client{GridMirror(kMap, requests), DocumentFetch(kTopology, 0, requests)}));
    return index;
  }

  void change_tiles(int count, std::int32_t spread) {
    GridChange change{7, 0.05, kSide, {}};
    for (int i = 0; i < count; ++i) {
      const TileIndex index{static_cast<std::int32_t>(bus_.random()() % spread_of(spread)),
                            static_cast<std::int32_t>(bus_.random()() % spread_of(spread))};
      change.tiles[index] = random_tile(bus_.random(), kSide);
    }
    server_->change(bus_.now_us(), 0, kMap, change);
  }

  /// Runs in steps of a millisecond; `each_step` gets the time since the start of this run.
  void run(std::int64_t duration_us, const std::function<void(std::int64_t)>& each_step = {}) {
    const std::int64_t start_us = bus_.now_us();
    for (std::int64_t t = 0; t < duration_us; t += kMillisecond) {
      bus_.advance_to(start_us + t);
      if (each_step) {
        each_step(t);
      }
      step(t);
    }
  }

  /// @return seconds until all mirrors are as the server's grid; -1: never
  double seconds_to_convergence(double limit_s) {
    for (double waited_s = 0.0; waited_s < limit_s; waited_s += 0.01) {
      if (is_converged()) {
        return waited_s;
      }
      run(10 * kMillisecond);
    }
    return -1.0;
  }

  [[nodiscard]] bool is_converged() const {
    return std::all_of(clients_.begin(), clients_.end(), [this](const auto& client) {
      return is_equal(client->mirror.grid(), *server_->grid(kMap));
    });
  }

  static bool is_equal(const ReplicatedGrid& a, const ReplicatedGrid& b) {
    return a.revision == b.revision && a.map_id == b.map_id &&
           std::equal(a.tiles.begin(), a.tiles.end(), b.tiles.begin(), b.tiles.end(),
                      [](const auto& x, const auto& y) {
                        return x.first == y.first && *x.second == *y.second;
                      });
  }

  struct Client {
    GridMirror mirror;
    DocumentFetch fetch;
  };
  Client& client(std::size_t index) { return *clients_.at(index); }
  ReplicationServer& server() { return *server_; }
  LossyBus& bus() { return bus_; }
  [[nodiscard]] int deltas_sent() const { return deltas_sent_; }
  [[nodiscard]] int requests_sent() const { return requests_sent_; }
  [[nodiscard]] std::int64_t bytes_sent() const { return bytes_sent_; }
  bool is_fetching = false;

  static constexpr std::int32_t kSide = 16;

 private:
  static std::uint32_t spread_of(std::int32_t spread) { return static_cast<std::uint32_t>(spread); }

  void to_all(const std::function<void(Client&, std::int64_t)>& take) {
    for (const auto& client : clients_) {
      bus_.send([this, take, target = client.get()] { take(*target, bus_.now_us()); });
    }
  }

  void step(std::int64_t t) {
    server_->pump(bus_.now_us(), bus_.now_us());
    if (t % kSecond == 0) {
      const std::int64_t boot_id = boot_id_;
      const std::int64_t revision = server_->revision(kMap);
      to_all([boot_id, revision](Client& client, std::int64_t) {
        client.mirror.on_status(boot_id, revision);
      });
    }
    if (t % (50 * kMillisecond) == 0) {
      for (const auto& client : clients_) {
        client->mirror.tick(bus_.now_us(), bus_.now_us());
        if (is_fetching) {
          client->fetch.tick(bus_.now_us(), bus_.now_us());
        }
      }
    }
  }

  LossyBus bus_;
  std::int64_t boot_id_ = 40;
  std::unique_ptr<ReplicationServer> server_;
  std::vector<std::unique_ptr<Client>> clients_;
  int deltas_sent_ = 0;
  int requests_sent_ = 0;
  std::int64_t bytes_sent_ = 0;
};

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

TEST(Replication, NothingIsAskedForOnceDeltasHaveOvertakenASnapshot) {
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
  int requests = 0;
  ReplicationRequests ask{1, [&](const auto&) { ++requests; }, [&](const auto&) { ++requests; }};
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
  for (std::int64_t t = 0; t < 10 * kSecond; t += 50 * kMillisecond) {
    mirror.tick(t, 0);
  }
  EXPECT_EQ(requests, 0);
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
