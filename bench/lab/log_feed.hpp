#pragma once

#include <functional>
#include <string>

#include "runtime/daemon_options.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"
#include "sensing/time.hpp"
#include "transport/inlets.hpp"

namespace cairn::lab {

/// Who takes what a log holds.
struct LogSinks {
  std::function<void(LaserScan)> scan;
  std::function<void(const OdometrySample&)> odometry;
  std::function<void()> before_message;  ///< Before each message is decoded; may be empty.
  std::function<void()> after_message;
  /// When the log has ended: what came of its messages. May be empty.
  std::function<void(const Inlets&)> at_end;
};

/// Reads a log from its beginning to its end, with a bar on a terminal. Throws
/// clients::Failure(kBadData) where there is no log.
/// @return what is wrong with the log; empty where all is well
[[nodiscard]] std::string feed_log(const std::string& log,
                                   const DaemonOptions& options,
                                   const LogSinks& sinks);

/// Throws clients::Failure(kBadData): a log without scans is none.
[[noreturn]] void refuse_without_scans(const std::string& log, const std::string& damage);

/// Seconds since the epoch.
[[nodiscard]] double seconds_of(TimePoint time);

}  // namespace cairn::lab
