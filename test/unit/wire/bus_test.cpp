#include "wire/bus.hpp"

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_samples.hpp"
#include "wire/signatures.hpp"
#include "wire/udp_drops.hpp"

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MemoryBus : public ::testing::Test {
 protected:
  void SetUp() override {
    Expected<std::unique_ptr<Bus>> bus = Bus::open("memq://");
    ASSERT_TRUE(bus.ok()) << bus.error();
    bus_ = *std::move(bus);
  }
  void hear(const std::string& channel) {
    ASSERT_TRUE(bus_->subscribe(channel, 10, [this](const Received& message) {
      heard_.emplace_back(message.channel);
      bytes_.assign(message.bytes, message.bytes + message.size);
    }));
  }

  std::unique_ptr<Bus> bus_;
  std::vector<std::string> heard_;
  Bytes bytes_;
};

TEST_F(MemoryBus, HandsOverBytesAsTheyWerePublished) {
  hear("LASER");
  const auto scan = test::sample<cairn_lcm::laser_scan_t>();
  EXPECT_TRUE(bus_->publish("LASER", scan));
  EXPECT_EQ(bus_->handle(1000), 1);
  EXPECT_EQ(bytes_, encode(scan));
}

TEST_F(MemoryBus, AChannelIsItsNameAndNoPattern) {
  hear("A.B");
  hear("LASER|ODOM");
  for (const char* const channel : {"A.B", "AXB", "LASER", "MY_ODOM", "LASER|ODOM"}) {
    EXPECT_TRUE(bus_->publish(channel, Bytes{1}));
  }
  while (bus_->handle(0) > 0) {
  }
  EXPECT_THAT(heard_, ElementsAre("A.B", "LASER|ODOM"));
}

TEST_F(MemoryBus, AnExceptionStaysWithinItsHandler) {
  ASSERT_TRUE(bus_->subscribe("BAD", 10, [](const Received&) { throw std::runtime_error("no"); }));
  hear("GOOD");
  EXPECT_TRUE(bus_->publish("BAD", Bytes{1}));
  EXPECT_TRUE(bus_->publish("GOOD", Bytes{1}));
  while (bus_->handle(0) > 0) {
  }
  EXPECT_EQ(bus_->failed_handlers(), 1U);
  EXPECT_THAT(heard_, ElementsAre("GOOD"));
}

TEST_F(MemoryBus, WaitsNoLongerThanItIsTold) {
  EXPECT_EQ(bus_->handle(1), 0);
}

TEST_F(MemoryBus, ChannelsThatLcmCannotCarryAreRefused) {
  EXPECT_FALSE(bus_->publish("", Bytes{1}));
  EXPECT_FALSE(bus_->publish(std::string(64, 'X'), Bytes{1}));
  EXPECT_TRUE(bus_->publish(std::string(63, 'X'), Bytes{1}));
}

TEST_F(MemoryBus, TwoThreadsMayPublish) {
  int heard = 0;
  ASSERT_TRUE(bus_->subscribe("X", 0, [&heard](const Received&) { ++heard; }));
  const auto publish_many = [this] {
    for (int i = 0; i < 500; ++i) {
      bus_->publish("X", Bytes{1});
    }
  };
  std::thread other(publish_many);
  publish_many();
  other.join();
  while (bus_->handle(0) > 0) {
  }
  EXPECT_EQ(heard, 1000);
}

TEST(BusUrl, AnUrlThatIsNoneIsRefusedWithAReason) {
  EXPECT_THAT(Bus::open("nonsense://").error(), HasSubstr("nonsense://"));
}

TEST(BusUrl, AMissingHubIsNamedWithWhatToType) {
  EXPECT_THAT(Bus::open("tcpq://127.0.0.1:1").error(), HasSubstr("cairn-hub"));
}

TEST(UdpDrops, AreKnownOnThisKernel) {
  EXPECT_GE(own_udp_drops().value_or(0), 0);
}

}  // namespace
}  // namespace cairn::wire
