#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "wire/expected.hpp"
#include "wire/wire_check.hpp"

namespace cairn::wire {

/// A recorded message, ready for the same inlets as a live one.
struct LogMessage {
  std::int64_t utime = 0;  ///< When it was recorded, microseconds.
  std::string channel;
  Bytes bytes;
};

/// Reads a recorded log in the order of the file: an LCM event log, as its messages are; or a
/// CARMEN text log, as messages of cairn_lcm:
///
///  - ODOM gives an odometry_t on ODOMETRY;
///  - FLASER and ROBOTLASER1 give the odometry_t of their own odometry, then a laser_scan_t on
///    LASER, both stamped as the scan; RAWLASER1 gives the scan alone. ROBOTLASER2 and RAWLASER2
///    go to LASER2, and so on.
///  - utime is the third field from the end (ipc_timestamp), rounded to the microsecond.
///
/// The logs write a sensor's "no return" as a large reading. A first pass over the file finds it:
/// where one of the largest readings occurs often, max_range_m of the scans lies just below it, so
/// that those readings mean "no return"; otherwise just above the largest reading.
class LogReader {
 public:
  /// Reads the beginning of the file, of a CARMEN log all of it once.
  [[nodiscard]] static Expected<LogReader> open(const std::string& file);
  LogReader(LogReader&& other) noexcept;
  LogReader& operator=(LogReader&& other) noexcept;
  ~LogReader();

  /// The next message; nothing at the end of the file, and where the file is damaged.
  [[nodiscard]] std::optional<LogMessage> next();

  /// The first thing that is wrong with the file, with its byte or its line; nothing where all is
  /// well. An event log cannot be read beyond it; of a CARMEN log only that line is left out. What
  /// was read stands.
  [[nodiscard]] const std::optional<std::string>& damage() const;
  [[nodiscard]] std::int64_t bytes_read() const;
  [[nodiscard]] std::int64_t bytes_total() const;
  /// Lines of a CARMEN log that carry nothing for us, counted by their first word.
  [[nodiscard]] const std::map<std::string, std::int64_t>& skipped_lines() const;

  class Source;

 private:
  explicit LogReader(std::unique_ptr<Source> source);
  std::unique_ptr<Source> source_;
};

}  // namespace cairn::wire
