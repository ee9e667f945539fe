#include "runtime/event_book.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace cairn {
namespace {

using Kind = cairn_lcm::place_event_t;

constexpr std::array<const char*, 8> kNames = {
    "ENTERED",        "LEFT", "GATEWAY_CONFIRMED", "GATEWAY_RETRACTED", "LOOP_CLOSED",
    "CLOSURE_UNDONE", "LOST", "LOCALIZED"};

std::string at_text(const Vector2d& p_lpm) {
  std::array<char, 64> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "at (%.2f, %.2f) m of the local map",
                                  p_lpm.x(), p_lpm.y()));
  return text.data();
}

}  // namespace

cairn_lcm::place_event_t EventBook::add(std::int32_t kind,
                                        TimePoint time,
                                        std::int64_t visit,
                                        std::int64_t place,
                                        const std::string& reason) {
  cairn_lcm::place_event_t event{};
  event.utime = utime_of(time);
  event.boot_id = boot_id_;
  event.event_number = ++newest_;
  event.kind = kind;
  event.kind_name = kNames[static_cast<std::size_t>(kind)];
  event.visit_id = visit;
  event.place_id = place;
  event.reason = reason;
  kept_.push_back(event);
  if (kept_.size() > kKept) {
    kept_.pop_front();
  }
  return event;
}

std::vector<cairn_lcm::place_event_t> EventBook::note(const PlaceEvent& event,
                                                      const MapState* state) {
  std::int32_t kind = Kind::ENTERED;
  std::string reason = at_text(event.p_lpm_center);
  std::int64_t visit = -1;
  std::int64_t place = -1;
  switch (event.kind) {
    case PlaceEventKind::kEntered:
      break;
    case PlaceEventKind::kLeft:
      kind = Kind::LEFT;
      if (event.visit) {
        reason += ", through gateway " + std::to_string(event.visit->departure_gateway) + " of " +
                  std::to_string(event.visit->neighbourhood.gateways.size());
      }
      if (state != nullptr) {
        visit = state->visit_count - 1;
        place = state->at_place;
      }
      break;
    case PlaceEventKind::kGatewayConfirmed:
      kind = Kind::GATEWAY_CONFIRMED;
      break;
    case PlaceEventKind::kGatewayRetracted:
      kind = Kind::GATEWAY_RETRACTED;
      break;
  }
  return {add(kind, event.time, visit, place, reason)};
}

std::vector<cairn_lcm::place_event_t> EventBook::note(const MapState& before,
                                                      const MapState& after) {
  std::vector<cairn_lcm::place_event_t> events;
  const auto common = std::min(before.place_of_visit.size(), after.place_of_visit.size());
  for (std::size_t visit = 0; visit < common; ++visit) {
    if (before.place_of_visit[visit] != after.place_of_visit[visit]) {
      events.push_back(add(Kind::CLOSURE_UNDONE, after.time, static_cast<std::int64_t>(visit),
                           after.place_of_visit[visit],
                           "hypothesis " + std::to_string(after.hypothesis) +
                               " explains more: visit " + std::to_string(visit) + " was to place " +
                               std::to_string(after.place_of_visit[visit]) + ", not " +
                               std::to_string(before.place_of_visit[visit])));
      break;  // All that follows from it is one change of belief.
    }
  }
  if (after.closure_count > before.closure_count) {
    events.push_back(add(Kind::LOOP_CLOSED, after.time, after.visit_count - 1, after.at_place,
                         "hypothesis " + std::to_string(after.hypothesis) + ": " +
                             std::to_string(after.closure_count) + " loops closed"));
  }
  if (before.hypothesis < 0 && after.hypothesis >= 0) {
    events.push_back(add(Kind::LOCALIZED, after.time, after.visit_count - 1, after.at_place,
                         "the first place is known: it fixes the global frame"));
  }
  return events;
}

std::vector<cairn_lcm::place_event_t> EventBook::note(const LocalisationHealth& before,
                                                      const LocalisationHealth& after,
                                                      const EventContext& context) {
  const bool was_lost = before.state == LocalisationState::kLost;
  const bool is_lost = after.state == LocalisationState::kLost;
  if (after.times_lost == before.times_lost && was_lost == is_lost) {
    return {};
  }
  const std::int32_t kind = is_lost ? std::int32_t{Kind::LOST} : std::int32_t{Kind::LOCALIZED};
  return {add(kind, context.time, -1, -1,
              is_lost ? context.reason : "in the local map: scans fit it again")};
}

std::vector<cairn_lcm::place_event_t> EventBook::note(const Relocalisation& found) {
  return {add(Kind::LOCALIZED, found.time, -1, found.place, to_text(found))};
}

std::vector<cairn_lcm::place_event_t> EventBook::after(std::int64_t number) const {
  std::vector<cairn_lcm::place_event_t> events;
  std::copy_if(
      kept_.begin(), kept_.end(), std::back_inserter(events),
      [number](const cairn_lcm::place_event_t& event) { return event.event_number > number; });
  return events;
}

}  // namespace cairn
