#pragma once

#include <cstdint>
#include <string>

namespace cairn::clients {

/// A bar on stderr for work that takes time; silent unless stderr is a terminal. Redrawn for a
/// whole percent only, wiped when it goes out of scope.
class Progress {
 public:
  explicit Progress(std::string what);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// A total of 0 is not known yet and draws nothing.
  void show(std::int64_t done, std::int64_t total);

 private:
  std::string what_;
  bool is_terminal_;
  int shown_percent_ = -1;
};

}  // namespace cairn::clients
