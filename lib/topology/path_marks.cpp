#include "topology/path_marks.hpp"

namespace cairn {
namespace {

/// Whether one of the places holds that lie on the paths that cross the one entered by `end`; the
/// path's own places are not asked.
template <typename Predicate>
bool any_on_crossings(const WorkingMap& map, GatewayIndex end, Predicate holds) {
  for (GatewayIndex entry = end; entry != kNoGateway; entry = next_entry(map, entry)) {
    const PlaceId place = map.place_of(entry);
    const GatewayIndex first = map.first_gateway(place);
    const GatewayIndex last = first + map.gateway_count(place);
    const GatewayIndex onward = map.through(entry);
    for (GatewayIndex exit = first; exit < last; ++exit) {
      if (exit == entry || exit == onward) {
        continue;
      }
      for (GatewayIndex at = map.leads_to(exit); at != kNoGateway; at = next_entry(map, at)) {
        if (holds(map.place_of(at))) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

void PathMarks::depart(GatewayIndex departure) {
  departure_ = departure;
  crossings_marked_ = false;
  ++now_;
  if (on_path_.size() < static_cast<std::size_t>(map_->place_count())) {
    on_path_.resize(static_cast<std::size_t>(map_->place_count()), 0);
    on_crossing_.resize(on_path_.size(), 0);
  }
  for (GatewayIndex at = departure; at != kNoGateway; at = next_entry(*map_, at)) {
    on_path_[map_->place_of(at).index()] = now_;
  }
}

void PathMarks::mark_crossings() {
  any_on_crossings(*map_, departure_, [&](PlaceId place) {
    on_crossing_[place.index()] = now_;
    return false;
  });
  crossings_marked_ = true;
}

PathMeeting PathMarks::meeting(GatewayIndex target, bool with_crossings) {
  for (GatewayIndex at = target; at != kNoGateway; at = next_entry(*map_, at)) {
    if (on_path_[map_->place_of(at).index()] == now_) {
      return PathMeeting::kSharePlace;
    }
  }
  if (!with_crossings) {
    return PathMeeting::kApart;
  }
  if (!crossings_marked_) {
    mark_crossings();
  }
  for (GatewayIndex at = target; at != kNoGateway; at = next_entry(*map_, at)) {
    if (on_crossing_[map_->place_of(at).index()] == now_) {
      return PathMeeting::kTwice;
    }
  }
  const bool has_triangle = any_on_crossings(
      *map_, target, [&](PlaceId place) { return on_crossing_[place.index()] == now_; });
  return has_triangle ? PathMeeting::kTriangle : PathMeeting::kApart;
}

}  // namespace cairn
