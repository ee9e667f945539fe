#pragma once

namespace cairn {

/// Exit status of the programs, after sysexits.h.
enum class ExitCode {
  kOk = 0,
  kUsage = 64,         ///< Wrong command line.
  kBadData = 65,       ///< A log or map file that cannot be used.
  kNoService = 69,     ///< No bus.
  kInternal = 70,      ///< A worker died.
  kCannotCreate = 73,  ///< The map file cannot be written.
  kConfig = 78,        ///< Wrong configuration.
};

[[nodiscard]] constexpr int to_status(ExitCode code) {
  return static_cast<int>(code);
}

}  // namespace cairn
