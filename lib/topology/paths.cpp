#include "topology/paths.hpp"

#include <algorithm>

namespace cairn {
namespace {

/// The end of the fragment chain reached by going on from a slot, as (place, slot) looking outward.
struct DirectedSlot {
  PlaceId place;
  std::size_t slot = 0;
  friend bool operator==(const DirectedSlot&, const DirectedSlot&) = default;
};

const StarSlot& slot_at(const TopologicalMap& map, DirectedSlot at) {
  return map.star(at.place).slots[at.slot];
}

DirectedSlot turned_round(const TopologicalMap& map, DirectedSlot at) {
  return {at.place, slot_at(map, at).partner};
}

/// The next place of the path in this direction, still looking the same way along the path.
std::optional<DirectedSlot> next_along(const TopologicalMap& map, DirectedSlot at) {
  const int gateway = slot_at(map, at).gateway;
  if (gateway < 0) {
    return std::nullopt;
  }
  const std::optional<GatewayRef> entry = map.linked_to({at.place, gateway});
  if (!entry) {
    return std::nullopt;
  }
  return turned_round(map, {entry->place, map.slot_of(*entry)});
}

DirectedSlot end_of_path(const TopologicalMap& map, DirectedSlot start) {
  DirectedSlot at = start;
  while (const std::optional<DirectedSlot> next = next_along(map, at)) {
    at = *next;
    if (at == start) {
      break;  // Circular: only in maps built against the axiom.
    }
  }
  return at;
}

Path path_from(const TopologicalMap& map, DirectedSlot start) {
  Path path;
  std::optional<DirectedSlot> at = start;
  do {
    path.stops.push_back({at->place, at->slot, slot_at(map, *at).partner});
    at = next_along(map, *at);
  } while (at && !(*at == start));
  return path;
}

}  // namespace

std::vector<Path> trace_paths(const TopologicalMap& map) {
  std::vector<std::vector<bool>> is_traced;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    is_traced.emplace_back(map.star(place).slots.size(), false);
  }
  std::vector<Path> paths;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    for (std::size_t slot = 0; slot < is_traced[place.index()].size(); ++slot) {
      if (is_traced[place.index()][slot]) {
        continue;
      }
      const DirectedSlot back = end_of_path(map, turned_round(map, {place, slot}));
      paths.push_back(path_from(map, turned_round(map, back)));
      for (const PathStop& stop : paths.back().stops) {
        is_traced[stop.place.index()][stop.forward_slot] = true;
        is_traced[stop.place.index()][stop.backward_slot] = true;
      }
    }
  }
  return paths;
}

std::vector<PlaceId> places_behind(const TopologicalMap& map, GatewayRef end) {
  std::vector<PlaceId> places;
  std::optional<GatewayRef> entry = end;
  while (entry) {
    places.push_back(entry->place);
    const std::optional<GatewayRef> onward = map.through(*entry);
    entry = onward ? map.linked_to(*onward) : std::nullopt;
  }
  return places;
}

bool would_repeat_a_place(const TopologicalMap& map, GatewayRef a, GatewayRef b) {
  const std::vector<PlaceId> places_a = places_behind(map, a);
  const std::vector<PlaceId> places_b = places_behind(map, b);
  return std::find_first_of(places_a.begin(), places_a.end(), places_b.begin(), places_b.end()) !=
         places_a.end();
}

}  // namespace cairn
