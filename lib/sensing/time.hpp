#pragma once

#include <chrono>
#include <cstdint>

namespace cairn {

/// Microseconds since the epoch, by the clock of the sender: `utime` on the wire. lib/ never reads
/// a clock; all times come with the data.
using TimePoint = std::chrono::sys_time<std::chrono::microseconds>;

[[nodiscard]] inline TimePoint time_of_utime(std::int64_t utime_us) {
  return TimePoint(std::chrono::microseconds(utime_us));
}
[[nodiscard]] inline std::int64_t utime_of(TimePoint time) {
  return time.time_since_epoch().count();
}
[[nodiscard]] inline double seconds_between(TimePoint from, TimePoint to) {
  return static_cast<double>((to - from).count()) * 1e-6;
}

}  // namespace cairn
