#include "clients/cairn/event_follower.hpp"

#include <algorithm>

namespace cairn::clients {
namespace {

constexpr std::size_t kMostEarly = 4'096;
constexpr std::int64_t kFirstAskUs = 100'000;  // Reordered ones come by themselves.
constexpr std::int64_t kAskEveryUs = 250'000;
constexpr int kTries = 5;

}  // namespace

void EventFollower::begin(std::int64_t boot_id, std::int64_t before_first) {
  boot_id_ = boot_id;
  have_ = before_first;
  newest_ = before_first;
  early_.clear();
  asked_ = 0;
  next_ask_us_ = 0;
}

void EventFollower::on_event(const cairn_lcm::place_event_t& event) {
  if (!have_ || event.boot_id != boot_id_) {
    begin(event.boot_id, event.event_number - 1);
  }
  newest_ = std::max(newest_, event.event_number);
  if (event.event_number > *have_ && early_.size() < kMostEarly) {
    early_.emplace(event.event_number, event);
  }
  drain();
}

void EventFollower::on_status(std::int64_t boot_id, std::int64_t newest_event) {
  if (!have_ || boot_id != boot_id_) {
    begin(boot_id, newest_event);
  }
  newest_ = std::max(newest_, newest_event);
}

void EventFollower::drain() {
  while (!early_.empty() && early_.begin()->first == *have_ + 1) {
    use_(early_.begin()->second);
    early_.erase(early_.begin());
    ++*have_;
    asked_ = 0;
    next_ask_us_ = 0;
  }
}

void EventFollower::tick(std::int64_t now_us) {
  if (!have_ || newest_ <= *have_) {
    return;
  }
  if (next_ask_us_ == 0) {
    next_ask_us_ = now_us + kFirstAskUs;
  }
  if (now_us < next_ask_us_) {
    return;
  }
  if (asked_ < kTries) {
    ++asked_;
    next_ask_us_ = now_us + kAskEveryUs;
    ask_(*have_);
    return;
  }
  const std::int64_t next = early_.empty() ? newest_ + 1 : early_.begin()->first;
  lost_(*have_ + 1, next - 1);
  have_ = next - 1;
  asked_ = 0;
  next_ask_us_ = 0;
  drain();
}

}  // namespace cairn::clients
