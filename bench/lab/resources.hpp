#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace cairn::lab {

/// CPU time of this process so far, all threads together.
[[nodiscard]] double cpu_time_s();

/// The most memory this process ever had.
[[nodiscard]] std::int64_t peak_resident_bytes();

/// Says on stderr how long something has been going on that cannot tell how far it is; silent
/// unless stderr is a terminal, and for the first two seconds. Wiped when it goes out of scope.
class Elapsed {
 public:
  explicit Elapsed(std::string what);
  Elapsed(const Elapsed&) = delete;
  Elapsed& operator=(const Elapsed&) = delete;
  ~Elapsed();

 private:
  void tell();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  std::thread teller_;
};

}  // namespace cairn::lab
