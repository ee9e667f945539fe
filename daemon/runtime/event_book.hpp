#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <cairn_lcm/place_event_t.hpp>

#include "lpm/localisation_health.hpp"
#include "place/place_detector.hpp"
#include "service/map_state.hpp"
#include "service/relocaliser.hpp"
#include "topology/extend_report.hpp"

namespace cairn {

/// What an event about the robot's pose says besides.
struct EventContext {
  TimePoint time;
  std::string reason;
};

/// Numbers the place events of one boot without gaps and keeps the last ones, so that a client who
/// missed some can ask for them.
class EventBook {
 public:
  static constexpr std::size_t kKept = 1024;

  explicit EventBook(std::int64_t boot_id) : boot_id_(boot_id) {}

  /// What the detector perceived.
  std::vector<cairn_lcm::place_event_t> note(const PlaceEvent& event, const MapState* state);
  /// What changed in the best map: loops closed, closures undone, the global frame fixed.
  std::vector<cairn_lcm::place_event_t> note(const MapState& before, const MapState& after);

  /// That the robot is lost in its local map, or found again.
  std::vector<cairn_lcm::place_event_t> note(const LocalisationHealth& before,
                                             const LocalisationHealth& after,
                                             const EventContext& context);

  /// That a lost robot was found in the map.
  std::vector<cairn_lcm::place_event_t> note(const Relocalisation& found);

  [[nodiscard]] std::int64_t newest() const { return newest_; }
  /// Those after the given number that are still kept.
  [[nodiscard]] std::vector<cairn_lcm::place_event_t> after(std::int64_t number) const;

 private:
  cairn_lcm::place_event_t add(std::int32_t kind,
                               TimePoint time,
                               std::int64_t visit,
                               std::int64_t place,
                               const std::string& reason);

  std::int64_t boot_id_;
  std::int64_t newest_ = 0;
  std::deque<cairn_lcm::place_event_t> kept_;
};

}  // namespace cairn
