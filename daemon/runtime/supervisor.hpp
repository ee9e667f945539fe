#pragma once

#include <chrono>
#include <string>

namespace cairn {

/// What systemd wants to hear: readiness, status line, watchdog, stopping. Outside of systemd every
/// call does nothing.
class Supervisor {
 public:
  Supervisor();

  void ready();
  void status(const std::string& line);
  void stopping();
  /// The worker has made progress, or has nothing to do. Passed on at a third of the watchdog's
  /// interval at most.
  void alive(std::chrono::steady_clock::time_point now);

 private:
  std::chrono::microseconds interval_{0};  ///< 0: no watchdog.
  std::chrono::steady_clock::time_point last_alive_;
};

}  // namespace cairn
