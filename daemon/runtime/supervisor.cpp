#include "runtime/supervisor.hpp"

#include <cstdint>

#include <systemd/sd-daemon.h>

namespace cairn {

Supervisor::Supervisor() {
  std::uint64_t watchdog_us = 0;
  if (sd_watchdog_enabled(0, &watchdog_us) > 0) {
    interval_ = std::chrono::microseconds(watchdog_us / 3);
  }
}

void Supervisor::ready() {
  sd_notify(0, "READY=1");
}

void Supervisor::status(const std::string& line) {
  sd_notify(0, ("STATUS=" + line).c_str());
}

void Supervisor::stopping() {
  sd_notify(0, "STOPPING=1");
}

void Supervisor::alive(std::chrono::steady_clock::time_point now) {
  if (interval_.count() > 0 && now - last_alive_ >= interval_) {
    sd_notify(0, "WATCHDOG=1");
    last_alive_ = now;
  }
}

}  // namespace cairn
