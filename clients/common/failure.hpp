#pragma once

#include <stdexcept>
#include <string>

namespace cairn::clients {

/// How a client program ends, in the numbers of sysexits.h.
enum class ExitCode {
  kOk = 0,
  kUsage = 64,      ///< The command line is wrong.
  kBadData = 65,    ///< A file or an answer is not what it should be, or names what is not there.
  kNoService = 69,  ///< No daemon answered, or it could not do it.
  kCannotCreate = 73,  ///< An output file cannot be written.
  kConfiguration = 78  ///< Wrong configuration, or the bus cannot be opened as configured.
};

/// Ends a command: one line for the person who typed it, and the exit status. Thrown by commands
/// and what they call, caught in main; never thrown through LCM's C frames.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace cairn::clients
