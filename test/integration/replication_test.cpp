// Replication over real multicast with the kernel's usual buffers: run by in_private_network.sh.

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/bus.hpp"
#include "wire/replication_client.hpp"
#include "wire/replication_server.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::int32_t kMap = cairn_lcm::map_delta_t::GLOBAL_MAP;
constexpr std::int32_t kSide = 64;
constexpr std::size_t kMaxBytes = 64 * 1024;

std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::unique_ptr<Bus> open_bus() {
  Expected<std::unique_ptr<Bus>> bus = Bus::open(kUrl);
  EXPECT_TRUE(bus.ok()) << bus.error();
  return bus.ok() ? *std::move(bus) : nullptr;
}

/// Incompressible, so that the map is as large on the wire as in memory.
GridChange random_map(int num_tiles) {
  std::mt19937 random(1);
  GridChange change{7, 0.05, kSide, {}};
  for (std::int32_t i = 0; i < num_tiles; ++i) {
    Bytes cells(static_cast<std::size_t>(kSide * kSide));
    for (std::uint8_t& cell : cells) {
      cell = static_cast<std::uint8_t>(random());
    }
    change.tiles[{i, 0}] = std::make_shared<const Bytes>(std::move(cells));
  }
  return change;
}

/// A daemon that does nothing but replicate, on a thread of its own.
void serve(const GridChange& map, const std::atomic<bool>& stop) {
  const auto bus = open_bus();
  ReplicationServer server(
      5, [&](const auto& chunk) { bus->publish("CAIRN_SNAPSHOT", chunk); },
      [&](const auto& delta) { bus->publish("CAIRN_MAP_DELTA", delta); });
  server.change(now_us(), 1, kMap, map);
  ASSERT_TRUE(bus->subscribe("CAIRN_REQUEST_SNAPSHOT", 64, [&](const Received& message) {
    const auto request =
        decode<cairn_lcm::snapshot_request_t>(message.bytes, message.size, kMaxBytes);
    ASSERT_TRUE(request.ok());
    server.on_request(now_us(), *request);
  }));
  while (!stop) {
    bus->handle(1);
    server.pump(now_us(), 1);
  }
}

TEST(ReplicationOverMulticast, AMapOfFiveMegabytesArrivesWhole) {
  if (std::getenv("CAIRN_TEST_ROUTE") == nullptr) {  // NOLINT(concurrency-mt-unsafe)
    GTEST_SKIP() << "there is no route";
  }
  const GridChange map = random_map(1250);
  std::atomic<bool> stop = false;
  std::thread server([&] { serve(map, stop); });
  const auto bus = open_bus();
  GridMirror mirror(
      kMap, {9, [&](const auto& request) { bus->publish("CAIRN_REQUEST_SNAPSHOT", request); },
             [](const auto&) {}});
  ASSERT_TRUE(bus->subscribe("CAIRN_SNAPSHOT", 1000, [&](const Received& message) {
    const auto chunk = decode<cairn_lcm::snapshot_chunk_t>(message.bytes, message.size, kMaxBytes);
    ASSERT_TRUE(chunk.ok());
    mirror.on_chunk(now_us(), *chunk);
  }));
  const std::int64_t start_us = now_us();
  while (mirror.grid().revision < 0 && now_us() - start_us < 30'000'000) {
    bus->handle(10);
    mirror.tick(now_us(), 1);
  }
  stop = true;
  server.join();
  ASSERT_EQ(mirror.grid().tiles.size(), map.tiles.size());
  for (const auto& [index, cells] : map.tiles) {
    ASSERT_EQ(*mirror.grid().tiles.at(index), *cells);
  }
  RecordProperty("milliseconds", std::to_string((now_us() - start_us) / 1000));
}

}  // namespace
}  // namespace cairn::wire
