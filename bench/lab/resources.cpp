#include "bench/lab/resources.hpp"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <utility>

#include <sys/resource.h>
#include <unistd.h>

#include "clients/common/text.hpp"

namespace cairn::lab {

double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::int64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

Elapsed::Elapsed(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) != 0) {
    teller_ = std::thread([this] { tell(); });
  }
}

Elapsed::~Elapsed() {
  if (teller_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    changed_.notify_all();
    teller_.join();
  }
}

void Elapsed::tell() {
  const auto start = std::chrono::steady_clock::now();
  bool is_shown = false;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, std::chrono::seconds(1), [this] { return is_done_; })) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (elapsed.count() >= 2.0) {
      std::fprintf(stderr, "\r\033[K%s: %s, %s", what_.c_str(),
                   clients::duration(elapsed.count()).c_str(),
                   clients::byte_size(peak_resident_bytes()).c_str());
      std::fflush(stderr);
      is_shown = true;
    }
  }
  if (is_shown) {
    std::fputs("\r\033[K", stderr);
  }
}

}  // namespace cairn::lab
