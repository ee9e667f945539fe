#pragma once
// A daemon and its clients on a bus that loses messages, in virtual time.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "wire/replication_client.hpp"
#include "wire/replication_server.hpp"

namespace cairn::wire::test {

inline constexpr std::int32_t kMap = cairn_lcm::map_delta_t::GLOBAL_MAP;
inline constexpr std::int32_t kTopology = cairn_lcm::snapshot_request_t::TOPOLOGY;
inline constexpr std::int64_t kMillisecond = 1'000;
inline constexpr std::int64_t kSecond = 1'000'000;

inline TileCells random_tile(std::mt19937& random, std::int32_t side) {
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

}  // namespace cairn::wire::test
