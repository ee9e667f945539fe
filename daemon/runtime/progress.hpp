#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace cairn {

/// A line on a terminal that shows how far long work has come. Silent where stderr is no terminal.
class Progress {
 public:
  Progress();

  /// Redraws the line, ten times a second at most.
  void show(const std::string& what, std::int64_t done, std::int64_t total);
  /// Clears the line.
  void finish();

 private:
  bool is_terminal_ = false;
  bool is_drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace cairn
