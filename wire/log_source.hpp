#pragma once
// Of log_reader.cpp and the formats it knows; nobody else's business.

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "wire/log_reader.hpp"

namespace cairn::wire {

/// A log of one format, opened.
class LogReader::Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  virtual std::optional<LogMessage> next() = 0;

  std::optional<std::string> damage;
  std::int64_t bytes_read = 0;
  std::int64_t bytes_total = 0;
  std::map<std::string, std::int64_t> skipped_lines;
};

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

/// @param file at its beginning
/// @pre bytes_total > 0; both
[[nodiscard]] std::unique_ptr<LogReader::Source> open_event_log(FileHandle file,
                                                                std::int64_t bytes_total);
[[nodiscard]] std::unique_ptr<LogReader::Source> open_carmen_log(FileHandle file,
                                                                 std::int64_t bytes_total);

/// First four bytes of every event of an LCM log.
inline constexpr std::uint32_t kEventMark = 0xEDA1DA01;
inline constexpr std::size_t kEventHeaderSize = 28;

}  // namespace cairn::wire
