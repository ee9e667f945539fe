#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "wire/expected.hpp"

namespace cairn::wire {

struct TcpqHubOptions {
  std::uint16_t port = 7700;  ///< 0: any free one.
  std::size_t max_message_bytes = std::size_t{64} << 20U;
  std::size_t max_queued_bytes = std::size_t{64} << 20U;  ///< For each client; the rest is dropped.
  std::size_t max_clients = 64;
};

/// Passes the messages of LCM's tcpq transport between the programs of this machine, where
/// multicast does not work. Listens on 127.0.0.1 only. A client that does not read loses messages;
/// it never holds up the others. One thread, no clock.
class TcpqHub {
 public:
  [[nodiscard]] static Expected<TcpqHub> open(const TcpqHubOptions& options);
  TcpqHub(TcpqHub&& other) noexcept;
  TcpqHub& operator=(TcpqHub&& other) noexcept;
  ~TcpqHub();

  /// What to give as LCM url: tcpq://127.0.0.1:PORT.
  [[nodiscard]] std::string url() const;
  /// Waits for traffic and serves it once. @return false when the listening socket has failed
  bool serve(int timeout_ms);

  [[nodiscard]] std::size_t num_clients() const;
  [[nodiscard]] std::uint64_t messages_passed() const;
  [[nodiscard]] std::uint64_t messages_dropped() const;

  class Impl;

 private:
  explicit TcpqHub(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::wire
