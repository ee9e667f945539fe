#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include <cairn_lcm/event_request_t.hpp>
#include <cairn_lcm/place_event_t.hpp>

namespace cairn::clients {

/// Puts the place events of a daemon in order: they are numbered without gaps within one boot, and
/// the bus may lose, repeat or reorder them. Begins with the first one it hears of; a gap is asked
/// for, and given up with a note after a while, since the daemon keeps only so many.
class EventFollower {
 public:
  using Use = std::function<void(const cairn_lcm::place_event_t&)>;
  using Ask = std::function<void(std::int64_t have_event_number)>;
  using Lost = std::function<void(std::int64_t first, std::int64_t last)>;

  EventFollower(Use use, Ask ask, Lost lost)
      : use_(std::move(use)), ask_(std::move(ask)), lost_(std::move(lost)) {}

  void on_event(const cairn_lcm::place_event_t& event);
  /// The heartbeat tells the newest number, so that a lost last event is noticed.
  void on_status(std::int64_t boot_id, std::int64_t newest_event);
  /// Asks where something is missing. To be called a few times a second.
  void tick(std::int64_t now_us);

 private:
  void begin(std::int64_t boot_id, std::int64_t before_first);
  void drain();

  Use use_;
  Ask ask_;
  Lost lost_;
  std::int64_t boot_id_ = 0;
  std::optional<std::int64_t> have_;  ///< Last number handed on.
  std::int64_t newest_ = 0;
  std::map<std::int64_t, cairn_lcm::place_event_t> early_;
  int asked_ = 0;  ///< Times for the present gap.
  std::int64_t next_ask_us_ = 0;
};

}  // namespace cairn::clients
