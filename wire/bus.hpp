#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "wire/expected.hpp"
#include "wire/wire_check.hpp"

typedef struct _lcm_t lcm_t;                    // NOLINT: as in lcm.h
typedef struct _lcm_recv_buf_t lcm_recv_buf_t;  // NOLINT: as in lcm.h

namespace cairn::wire {

/// Where the bus is when nobody says: this machine's multicast group.
inline constexpr std::string_view kDefaultUrl =
    "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152";
/// Where cairn-hub listens.
inline constexpr std::string_view kHubUrl = "tcpq://127.0.0.1:7700";
/// LCM refuses longer channel names over UDP.
inline constexpr std::size_t kMaxChannelLength = 63;

/// The url given, else LCM_DEFAULT_URL of the environment, else kDefaultUrl.
[[nodiscard]] std::string effective_url(const std::string& url);

/// A message as it comes off the bus; valid during the call only.
struct Received {
  std::string_view channel;
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
  std::int64_t receive_utime = 0;  ///< Microseconds since the epoch.
};

/// The one door to LCM of daemon and clients. `handle` belongs to one thread; `publish` may be
/// called from any.
class Bus {
 public:
  using Handler = std::function<void(const Received&)>;

  /// Opens and tests the bus. An error is one or two lines that say what to type, e.g. when the
  /// machine has no multicast route.
  /// @param url of LCM (udpm://, tcpq://, memq://); empty: see effective_url
  [[nodiscard]] static Expected<std::unique_ptr<Bus>> open(const std::string& url);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Calls the handler, from within `handle`, for every message of this very channel. For the life
  /// of the bus. An exception out of the handler is caught and counted.
  /// @param queue_capacity messages LCM keeps for us; when it is full the newest is lost
  /// @return false where LCM refuses
  [[nodiscard]] bool subscribe(const std::string& channel, int queue_capacity, Handler handler);
  /// The same for every channel on the bus: for loggers and monitors.
  [[nodiscard]] bool subscribe_to_all(int queue_capacity, Handler handler);

  /// @return false where it cannot have been sent. True is no proof of arrival.
  bool publish(const std::string& channel, const Bytes& bytes);
  template <class T>
  bool publish(const std::string& channel, const T& message) {
    return publish(channel, encode(message));
  }

  /// Waits for messages and hands them to the handlers.
  /// @param timeout_ms for the first one; 0 only looks, -1 waits for ever
  /// @return messages handled, 0 when there were none in time, -1 when the connection is gone
  int handle(int timeout_ms, int max_messages = 64);

  /// Tries to get a lost connection back, which happens when the hub of tcpq ends. LCM writes a
  /// line to stderr each time, so once a second is often enough.
  /// @return whether the bus is connected now
  bool reconnect();

  /// To be polled for reading; ask each time, since a reconnection changes it. -1: not connected.
  [[nodiscard]] int fileno();
  [[nodiscard]] const std::string& url() const { return url_; }
  /// Exceptions that were caught from handlers.
  [[nodiscard]] std::uint64_t failed_handlers() const { return failed_handlers_; }

 private:
  struct Subscription {
    Bus* bus = nullptr;
    Handler handler;
  };

  Bus(lcm_t* lcm, std::string url) : lcm_(lcm), url_(std::move(url)) {}
  static void receive(const lcm_recv_buf_t* buffer, const char* channel, void* user) noexcept;
  bool subscribe_to_pattern(const std::string& pattern, int queue_capacity, Handler handler);

  lcm_t* lcm_;
  std::string url_;
  std::mutex publish_mutex_;  ///< LCM locks publishing over UDP, but not over TCP or in memory.
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::uint64_t failed_handlers_ = 0;
};

}  // namespace cairn::wire
