#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "wire/wire_check.hpp"

namespace cairn::wire {

/// How long a client waits for a result. Times in microseconds, by any clock that never steps.
struct RetryOptions {
  std::int64_t first_wait_us = 250'000;
  double growth = 1.5;
  std::int64_t longest_wait_us = 2'000'000;
  int tries = 6;
};

/// When to send a request again, and when to give up. Repeats carry the same request_id: the server
/// does no work twice.
class RequestRetry {
 public:
  enum class Step {
    kWait,    ///< Nothing to do before `next_us`.
    kSend,    ///< Send it, again or for the first time.
    kGiveUp,  ///< Nobody answers.
  };

  explicit RequestRetry(RetryOptions options = {})
      : options_(options), wait_us_(options.first_wait_us) {}

  /// What to do now. Each kSend counts as one try.
  [[nodiscard]] Step step(std::int64_t now_us);
  /// The server has taken the request up and works: tries are counted afresh.
  void accepted(std::int64_t now_us);
  /// The server asks to come back later; this does not count as a try.
  void busy(std::int64_t now_us, std::int64_t retry_after_us);
  [[nodiscard]] std::int64_t next_us() const { return next_us_; }

 private:
  RetryOptions options_;
  std::int64_t wait_us_;
  std::int64_t next_us_ = 0;
  int tries_ = 0;
};

/// The results of the last 16 requests of the last 64 clients, so that a repeated request gets the
/// stored answer.
class ResultCache {
 public:
  static constexpr std::size_t kClients = 64;
  static constexpr std::size_t kResultsPerClient = 16;

  struct Result {
    std::string channel;
    Bytes bytes;
  };

  /// Nothing where this request is new. Valid until the next `store`.
  [[nodiscard]] const Result* find(std::int64_t client_id, std::int32_t request_id) const;
  /// A later result of the same request, as the final one after ACCEPTED, takes the place of the
  /// earlier.
  void store(std::int64_t client_id, std::int32_t request_id, Result result);

 private:
  struct Entry {
    std::int32_t request_id = 0;
    Result result;
  };
  struct Client {
    std::int64_t id = 0;
    std::deque<Entry> entries;  ///< Oldest first.
  };

  std::deque<Client> clients_;  ///< The one served longest ago first.
};

}  // namespace cairn::wire
