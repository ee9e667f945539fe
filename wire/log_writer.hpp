#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "wire/expected.hpp"
#include "wire/wire_check.hpp"

namespace cairn::wire {

/// Writes an LCM event log, as lcm-logger does.
class LogWriter {
 public:
  /// Replaces a file of this name.
  [[nodiscard]] static Expected<LogWriter> open(const std::string& file);

  /// @return false where the disk refuses, from then on
  bool write(std::int64_t utime, std::string_view channel, const Bytes& bytes);
  template <class T>
  bool write(std::int64_t utime, std::string_view channel, const T& message) {
    return write(utime, channel, encode(message));
  }
  /// Hands everything to the system and closes the file.
  /// @return false where any write has failed
  [[nodiscard]] bool close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  explicit LogWriter(std::FILE* file) : file_(file) {}

  std::unique_ptr<std::FILE, Closer> file_;
  std::int64_t next_event_ = 0;
  bool has_failed_ = false;
};

}  // namespace cairn::wire
