#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "support/files.hpp"

namespace cairn::test {

struct Finished {
  int status = -1;  ///< Exit status; 128 + number of the signal that ended it.
  std::string output;
  std::string errors;
};

/// A program running beside the test; ended, and waited for, with this object.
class Process {
 public:
  /// @param arguments the program first
  Process(const std::vector<std::string>& arguments, const TemporaryFolder& folder);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  Process(Process&&) = delete;
  Process& operator=(Process&&) = delete;

  void send(int signal) const;
  /// Waits for its end; after `patience` it is killed.
  Finished wait(std::chrono::seconds patience = std::chrono::seconds(120));
  /// What it has written to stdout and stderr so far.
  [[nodiscard]] std::string output() const { return content_of(output_); }
  [[nodiscard]] std::string errors() const { return content_of(errors_); }
  [[nodiscard]] bool is_running();

 private:
  pid_t pid_ = -1;
  int status_ = -1;
  std::filesystem::path output_;
  std::filesystem::path errors_;
};

/// Runs a program to its end.
Finished run(const std::vector<std::string>& arguments, const TemporaryFolder& folder);

/// A bus of its own on the loopback.
class Hub {
 public:
  explicit Hub(const TemporaryFolder& folder);
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  Process process_;
  std::string url_;
};

/// Asks until the condition holds, for a minute at most.
template <typename Condition>
bool eventually(const Condition& holds) {
  for (int i = 0; i < 600; ++i) {
    if (holds()) {
      return true;
    }
    timespec pause{0, 100'000'000};
    nanosleep(&pause, nullptr);
  }
  return false;
}

}  // namespace cairn::test
