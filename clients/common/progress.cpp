#include "clients/common/progress.hpp"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace cairn::clients {
namespace {

constexpr int kBarColumns = 30;

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_percent_ >= 0) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::show(std::int64_t done, std::int64_t total) {
  if (!is_terminal_ || total <= 0) {
    return;
  }
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  if (percent == shown_percent_) {
    return;
  }
  shown_percent_ = percent;
  const auto filled = static_cast<std::size_t>(percent * kBarColumns / 100);
  const std::string bar =
      std::string(filled, '#') + std::string(static_cast<std::size_t>(kBarColumns) - filled, '.');
  std::fprintf(stderr, "\r%s [%s] %3d %%", what_.c_str(), bar.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace cairn::clients
