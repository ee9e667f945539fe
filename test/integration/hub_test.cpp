#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "wire/bus.hpp"
#include "wire/tcpq_hub.hpp"

// LCM 1.3.1 leaks a few bytes with each tcpq connection, allocated by glib.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:g_malloc\n";
}  // NOLINT

namespace cairn::wire {
namespace {

/// Far more than anything here takes; only a failing test waits for so long.
constexpr int kPatience = 500;

std::unique_ptr<Bus> open_bus(const std::string& url) {
  Expected<std::unique_ptr<Bus>> bus = Bus::open(url);
  EXPECT_TRUE(bus.ok()) << bus.error();
  return bus.ok() ? *std::move(bus) : nullptr;
}

class Hub : public ::testing::Test {
 protected:
  void SetUp() override { start_hub(0); }
  void start_hub(std::uint16_t port) {
    TcpqHubOptions options;
    options.port = port;
    options.max_queued_bytes = std::size_t{8} << 20U;
    Expected<TcpqHub> hub = TcpqHub::open(options);
    ASSERT_TRUE(hub.ok()) << hub.error();
    url_ = hub->url();
    thread_ = std::thread([this, serving = *std::move(hub)]() mutable {
      while (!stop_) {
        serving.serve(5);
      }
      dropped_ = serving.messages_dropped();
    });
  }
  void TearDown() override { stop_hub(); }
  void stop_hub() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  /// A subscription is not acknowledged: messages are sent until one comes through.
  static void make_ready(Bus& sender, Bus& receiver) {
    bool is_ready = false;
    ASSERT_TRUE(receiver.subscribe("READY", 100, [&](const Received&) { is_ready = true; }));
    for (int i = 0; i < kPatience && !is_ready; ++i) {
      sender.publish("READY", Bytes{1});
      receiver.handle(10);
    }
    ASSERT_TRUE(is_ready);
  }
  [[nodiscard]] int connect_raw() const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(url_.substr(url_.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return fd;
  }

  std::string url_;
  std::atomic<bool> stop_ = false;
  std::uint64_t dropped_ = 0;
  std::thread thread_;
};

TEST_F(Hub, PassesMessagesOfAnySizeToWhoWantsThem) {
  const auto sender = open_bus(url_);
  const auto receiver = open_bus(url_);
  std::vector<std::size_t> sizes;
  ASSERT_TRUE(receiver->subscribe("A.B", 100,
                                  [&](const Received& message) { sizes.push_back(message.size); }));
  make_ready(*sender, *receiver);
  for (const std::size_t size : {std::size_t{1}, std::size_t{100'000}, std::size_t{5'000'000}}) {
    sender->publish("AXB", Bytes(size));
    sender->publish("A.B", Bytes(size));
  }
  for (int i = 0; i < kPatience && sizes.size() < 3; ++i) {
    receiver->handle(10);
  }
  EXPECT_THAT(sizes, ::testing::ElementsAre(1, 100'000, 5'000'000));
}

TEST_F(Hub, AClientThatDoesNotReadHoldsNobodyUp) {
  const auto sender = open_bus(url_);
  const auto sleeper = open_bus(url_);
  const auto receiver = open_bus(url_);
  ASSERT_TRUE(sleeper->subscribe("DATA", 100, [](const Received&) {}));
  make_ready(*sender, *sleeper);
  int received = 0;
  ASSERT_TRUE(receiver->subscribe("DATA", 1000, [&](const Received&) { ++received; }));
  make_ready(*sender, *receiver);
  for (int i = 0; i < 60; ++i) {
    sender->publish("DATA", Bytes(1'000'000));
    receiver->handle(0);
  }
  for (int i = 0; i < kPatience && received < 60; ++i) {
    receiver->handle(10);
  }
  EXPECT_EQ(received, 60);
  stop_hub();
  EXPECT_GT(dropped_, 0U);
}

TEST_F(Hub, AStrangerIsThrownOutAndTheOthersGoOn) {
  const auto sender = open_bus(url_);
  const auto receiver = open_bus(url_);
  for (const std::string& nonsense :
       {std::string(100, 'x'), std::string("\x28\x76\x17\xFB\0\0\1\0\0\0\0\1\xFF\xFF\xFF\xFF", 16),
        std::string("\x28\x76\x17\xFB\0\0\1\0\0\0\0\1\0\0\0\1A\xFF\xFF\xFF\xFF", 21)}) {
    const int fd = connect_raw();
    ASSERT_EQ(::send(fd, nonsense.data(), nonsense.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(nonsense.size()));
    char block[64];
    while (::recv(fd, block, sizeof block, 0) > 0) {  // The greeting, then the end.
    }
    ::close(fd);
  }
  make_ready(*sender, *receiver);
}

TEST_F(Hub, PatternsThatAreNoneAreIgnored) {
  const auto sender = open_bus(url_);
  const auto receiver = open_bus(url_);
  const int fd = connect_raw();
  const std::string subscribe("\x28\x76\x17\xFB\0\0\1\0\0\0\0\2\0\0\0\7(a{255}\0\0\0\2\0\0\0\1(",
                              32);
  ASSERT_EQ(::send(fd, subscribe.data(), subscribe.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(subscribe.size()));
  make_ready(*sender, *receiver);
  ::close(fd);
}

TEST_F(Hub, ABusFindsAHubThatHasComeBack) {
  const auto bus = open_bus(url_);
  stop_hub();
  EXPECT_EQ(bus->handle(2000), -1);
  EXPECT_FALSE(bus->reconnect());
  stop_ = false;
  start_hub(static_cast<std::uint16_t>(std::stoi(url_.substr(url_.rfind(':') + 1))));
  EXPECT_TRUE(bus->reconnect());
  make_ready(*bus, *bus);
}

TEST(HubAddress, APortInUseIsNamed) {
  TcpqHubOptions options;
  options.port = 0;
  Expected<TcpqHub> first = TcpqHub::open(options);
  ASSERT_TRUE(first.ok());
  const std::string url = first->url();
  options.port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  EXPECT_THAT(TcpqHub::open(options).error(), ::testing::HasSubstr("in use"));
}

}  // namespace
}  // namespace cairn::wire
