// Real multicast: run by in_private_network.sh, which makes the network first.

#include <cstdlib>
#include <memory>
#include <string>

#include <cairn_lcm/laser_scan_t.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/bus.hpp"
#include "wire/signatures.hpp"
#include "wire/udp_drops.hpp"

namespace cairn::wire {
namespace {

using ::testing::HasSubstr;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

bool has_route() {
  return std::getenv("CAIRN_TEST_ROUTE") != nullptr;
}  // NOLINT

TEST(Multicast, AMachineWithoutARouteIsToldWhatToType) {
  if (has_route()) {
    GTEST_SKIP() << "there is a route";
  }
  const auto bus = Bus::open(kUrl);
  ASSERT_FALSE(bus.ok());
  EXPECT_THAT(bus.error(), HasSubstr("ip route add 239.255.76.67/32 dev lo src 127.0.0.1"));
  EXPECT_THAT(bus.error(), HasSubstr("--lcm-url tcpq://127.0.0.1:7700"));
}

TEST(Multicast, MessagesComeFromOneProgramToAnother) {
  if (!has_route()) {
    GTEST_SKIP() << "there is no route";
  }
  auto sender = Bus::open(kUrl);
  auto receiver = Bus::open(kUrl);
  ASSERT_TRUE(sender.ok()) << sender.error();
  ASSERT_TRUE(receiver.ok()) << receiver.error();
  int received = 0;
  ASSERT_TRUE((*receiver)->subscribe("LASER", 100, [&received](const Received& message) {
    received += decode<cairn_lcm::laser_scan_t>(message.bytes, message.size, 1 << 18).ok() ? 1 : 0;
  }));
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE((*sender)->publish("LASER", cairn_lcm::laser_scan_t{}));
    (*receiver)->handle(1000);
  }
  EXPECT_EQ(received, 20);
}

TEST(Multicast, WhatTheKernelThrowsAwayIsCounted) {
  if (!has_route()) {
    GTEST_SKIP() << "there is no route";
  }
  auto sender = Bus::open(kUrl);
  auto receiver = Bus::open(kUrl);
  ASSERT_TRUE(sender.ok() && receiver.ok());
  ASSERT_TRUE((*receiver)->subscribe("DATA", 1, [](const Received&) {}));
  const std::int64_t before = own_udp_drops().value_or(0);
  for (int i = 0; i < 20; ++i) {
    (*sender)->publish("DATA", Bytes(5'000'000));
  }
  EXPECT_GT(own_udp_drops().value_or(0), before);
}

}  // namespace
}  // namespace cairn::wire
