#include "topology/planarity.hpp"

#include <algorithm>

namespace cairn {
namespace {

GatewayRef clockwise_of(const TopologicalMap& map, GatewayRef at) {
  return {at.place, (at.gateway + 1) % map.gateway_count(at.place)};
}

/// One step of the walk around a face: past this gateway, or through it to the other end of its
/// link, and on to the next gateway clockwise.
GatewayRef next_on_face(const TopologicalMap& map, GatewayRef at) {
  return clockwise_of(map, map.linked_to(at).value_or(at));
}

}  // namespace

std::vector<GatewayRef> pending_on_face(const TopologicalMap& map, GatewayRef gateway) {
  std::vector<GatewayRef> pending;
  for (GatewayRef at = next_on_face(map, gateway); at != gateway; at = next_on_face(map, at)) {
    if (map.is_pending(at)) {
      pending.push_back(at);
    }
  }
  return pending;
}

bool can_link_in_plane(const TopologicalMap& map, GatewayRef a, GatewayRef b) {
  if (map.component(a.place) != map.component(b.place)) {
    return true;
  }
  const std::vector<GatewayRef> face = pending_on_face(map, a);
  return std::find(face.begin(), face.end(), b) != face.end();
}

int genus(const TopologicalMap& map) {
  // Every gateway is passed by exactly one walk, so each orbit of the walk is a face.
  std::vector<std::vector<bool>> is_passed;
  int linked_ends = 0;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    is_passed.emplace_back(static_cast<std::size_t>(map.gateway_count(place)), false);
  }
  int faces = 0;
  for (GatewayRef start{{0}, 0}; start.place.value < map.place_count(); ++start.place.value) {
    for (start.gateway = 0; start.gateway < map.gateway_count(start.place); ++start.gateway) {
      linked_ends += map.linked_to(start) ? 1 : 0;
      GatewayRef at = start;
      const auto passed = [&] { return is_passed[at.place.index()].begin() + at.gateway; };
      faces += *passed() ? 0 : 1;
      for (; !*passed(); at = next_on_face(map, at)) {
        *passed() = true;
      }
    }
  }
  return (linked_ends / 2 + 2 * map.component_count() - map.place_count() - faces) / 2;
}

}  // namespace cairn
