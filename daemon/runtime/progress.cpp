#include "runtime/progress.hpp"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace cairn {

Progress::Progress() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::show(const std::string& what, std::int64_t done, std::int64_t total) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_terminal_ || (is_drawn_ && now - last_ < std::chrono::milliseconds(100))) {
    return;
  }
  last_ = now;
  is_drawn_ = true;
  constexpr int kWidth = 30;
  const double share =
      total > 0 ? std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0) : 0;
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  static_cast<void>(
      std::fprintf(stderr, "\r[%s] %3.0f %%  %s\033[K", bar.c_str(), 100.0 * share, what.c_str()));
  static_cast<void>(std::fflush(stderr));
}

void Progress::finish() {
  if (is_drawn_) {
    static_cast<void>(std::fprintf(stderr, "\r\033[K"));
    static_cast<void>(std::fflush(stderr));
    is_drawn_ = false;
  }
}

}  // namespace cairn
