#pragma once

namespace cairn {

/// SIGTERM, SIGINT and SIGHUP as a file descriptor to poll. Construct it before any thread: the
/// signals stay blocked in all threads that start afterwards.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  StopSignal(StopSignal&&) = delete;
  StopSignal& operator=(StopSignal&&) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  /// Whether SIGTERM or SIGINT has come since the last call; SIGHUP is taken and ignored.
  [[nodiscard]] bool was_raised();

 private:
  int fd_ = -1;
};

}  // namespace cairn
