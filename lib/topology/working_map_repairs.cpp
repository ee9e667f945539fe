// The rare changes of a map: parts without a link, stars that were misread, places that were passed
// without notice. They may cost a walk around a face or over the places.

#include "base/check.hpp"
#include "topology/working_map.hpp"

namespace cairn {

GatewayIndex WorkingMap::clockwise_of(GatewayIndex at) const {
  const PlaceId place = place_of(at);
  const GatewayIndex first = first_gateway(place);
  return at + 1 == first + gateway_count(place) ? first : at + 1;
}

bool WorkingMap::is_in_ring(GatewayIndex at) const {
  return is_pending(at) && of(at).next != kNoGateway;
}

/// Puts a pending gateway before the one that follows clockwise on its face.
void WorkingMap::enter_ring(GatewayIndex at) {
  GatewayIndex successor = kNoGateway;
  if (rings_ == Rings::kOne) {
    for (GatewayIndex other = 0; other < end_gateway() && successor == kNoGateway; ++other) {
      // Gateways that a changed star left behind belong to no place any more.
      const bool is_of_its_place = other >= first_gateway(place_of(other)) &&
                                   number_of(other) < gateway_count(place_of(other));
      successor = is_of_its_place && other != at && is_in_ring(other) ? other : kNoGateway;
    }
  } else {
    GatewayIndex walked = clockwise_of(at);
    while (walked != at && !is_in_ring(walked)) {
      walked = clockwise_of(is_linked(walked) ? leads_to(walked) : walked);
    }
    successor = walked == at ? kNoGateway : walked;
  }
  if (successor == kNoGateway) {
    of(at).next = of(at).previous = at;
    return;
  }
  of(at).next = successor;
  of(at).previous = of(successor).previous;
  rejoin_ring(at);
}

// Every link made while there may be several components leaves a mark, so that its undo knows.
void WorkingMap::join_components(GatewayIndex a, GatewayIndex b) {
  const std::int32_t kept = places_[place_of(a).index()].component;
  const std::int32_t joined = places_[place_of(b).index()].component;
  std::int32_t count = 0;
  if (kept != joined) {
    for (std::size_t index = 0; index < places_.size(); ++index) {
      if (places_[index].component == joined) {
        saved_.push_back({{static_cast<std::int32_t>(index)}, joined});
        places_[index].component = kept;
        ++count;
      }
    }
    --component_count_;
  }
  saved_.push_back({{}, count});
}

void WorkingMap::part_components() {
  const std::int32_t count = saved_.back().value;
  saved_.pop_back();
  for (std::int32_t i = 0; i < count; ++i) {
    places_[saved_.back().place.index()].component = saved_.back().value;
    saved_.pop_back();
  }
  component_count_ += count > 0 ? 1 : 0;
}

void WorkingMap::add_stray_place(const MapChange& change) {
  const GatewayIndex first = append_place(change.star, change.visit, next_component_++);
  const int count = stars_->gateway_count(change.star);
  ++component_count_;
  if (change.departure != kNoGateway) {
    of(first + change.target).leads_to = change.departure;
    leave_ring(first + change.target);
    --pending_count_;
    ++one_way_count_;
  }
  if (rings_ == Rings::kOne) {
    for (GatewayIndex at = first; at < first + count; ++at) {
      of(at).next = kNoGateway;
    }
    for (GatewayIndex at = first; at < first + count; ++at) {
      if (is_pending(at)) {
        enter_ring(at);
      }
    }
  }
}

void WorkingMap::remove_stray_place(const MapChange& change) {
  const GatewayIndex first = places_.back().first_gateway;
  if (rings_ == Rings::kOne) {
    for (GatewayIndex at = end_gateway() - 1; at >= first; --at) {
      if (is_pending(at)) {
        leave_ring(at);
      }
    }
  }
  if (change.departure != kNoGateway) {
    ++pending_count_;
    --one_way_count_;
  }
  --component_count_;
  --next_component_;
  remove_last_place();
}

/// Hands over where the gateway leads, who leads to it, and its position in its ring.
void WorkingMap::move_gateway(GatewayIndex from, GatewayIndex to) {
  const GatewayIndex end = of(from).leads_to;
  const bool was_linked = is_linked(from);
  of(to).leads_to = end;
  if (was_linked) {
    of(end).leads_to = to;
  }
  if (one_way_count_ > 0) {
    for (Gateway& other : gateways_) {
      other.leads_to = other.leads_to == from ? to : other.leads_to;
    }
  }
  if (end != kNoGateway) {
    return;
  }
  const bool is_alone = of(from).next == from;
  of(to).next = is_alone ? to : of(from).next;
  of(to).previous = is_alone ? to : of(from).previous;
  rejoin_ring(to);
}

/// A gateway more or less moves the numbers of those clockwise of it. Who looked into one that
/// turns out not to exist, carried there, is said to have looked into the next one. The records are
/// written anew, so that the undo finds the old ones.
void WorkingMap::renumber_records(Place& place, int before, const MapChange& change) {
  const int after = stars_->gateway_count(change.star);
  saved_.push_back({{}, place.latest_record});
  saved_.push_back({{}, static_cast<std::int32_t>(records_.size())});
  if (after == before) {
    return;
  }
  const auto first_new = records_.size();
  for (std::int32_t index = place.latest_record; index >= 0; index = record(index).previous) {
    VisitRecord moved = record(index);
    const int first_moved = change.target + (after < before ? 1 : 0);
    moved.number += moved.number >= first_moved ? after - before : 0;
    moved.number %= after;
    moved.previous = static_cast<std::int32_t>(records_.size()) + 1;
    records_.push_back(moved);
  }
  if (records_.size() > first_new) {
    records_.back().previous = -1;
    place.latest_record = static_cast<std::int32_t>(first_new);
  }
}

void WorkingMap::restore_records(Place& place) {
  records_.resize(static_cast<std::size_t>(saved_.back().value));
  saved_.pop_back();
  place.latest_record = saved_.back().value;
  saved_.pop_back();
}

// The place's gateways move to the end of the list, one more or one less of them; those left behind
// wait for the undo.
void WorkingMap::change_star(const MapChange& change) {
  const PlaceId id = place_of(change.departure);
  Place& place = places_[id.index()];
  const int before = stars_->gateway_count(place.star);
  const int after = stars_->gateway_count(change.star);
  const GatewayIndex old_first = place.first_gateway;
  CAIRN_CHECK(after - before <= 1 && before - after <= 1);
  saved_.push_back({{}, place.seen_at.value});
  saved_.push_back({{}, place.star.value});
  saved_.push_back({{}, old_first});
  path_count_ += stars_->fragment_count(change.star) - stars_->fragment_count(place.star);
  pending_count_ += after - before;
  const int extra = after > before ? change.target : -1;
  const int dropped = after < before ? change.target : -1;
  const auto first = static_cast<GatewayIndex>(gateways_.size());
  gateways_.resize(gateways_.size() + static_cast<std::size_t>(after));
  for (int number = 0; number < after; ++number) {
    of(first + number).place = id.value;
  }
  if (dropped >= 0) {
    leave_ring(old_first + dropped);
  }
  int to = 0;
  for (int number = 0; number < before; ++number) {
    to += to == extra ? 1 : 0;
    if (number != dropped) {
      move_gateway(old_first + number, first + to++);
    }
  }
  place.star = change.star;
  place.seen_at = change.visit;
  place.first_gateway = first;
  renumber_records(place, before, change);
  fill_from_star(first, change.star);
  if (extra >= 0) {
    enter_ring(first + extra);
  }
}

void WorkingMap::restore_star(const MapChange& change) {
  const PlaceId id = place_of(change.departure);
  Place& place = places_[id.index()];
  const int after = stars_->gateway_count(change.star);
  const GatewayIndex first = place.first_gateway;
  restore_records(place);
  const GatewayIndex old_first = saved_.back().value;
  saved_.pop_back();
  const StarId old_star{saved_.back().value};
  saved_.pop_back();
  const VisitId old_seen_at{saved_.back().value};
  saved_.pop_back();
  const int before = stars_->gateway_count(old_star);
  const int extra = after > before ? change.target : -1;
  const int dropped = after < before ? change.target : -1;
  if (extra >= 0) {
    leave_ring(first + extra);
  }
  int from = after - 1;
  for (int number = before - 1; number >= 0; --number) {
    if (number == dropped) {
      continue;
    }
    from -= from == extra ? 1 : 0;
    move_gateway(first + from--, old_first + number);
  }
  if (dropped >= 0) {
    rejoin_ring(old_first + dropped);
  }
  path_count_ += stars_->fragment_count(old_star) - stars_->fragment_count(change.star);
  pending_count_ += before - after;
  place.star = old_star;
  place.seen_at = old_seen_at;
  place.first_gateway = old_first;
  gateways_.resize(static_cast<std::size_t>(first));
}

// One fragment of the new place takes the link over; its other gateways lie on the faces left and
// right of it.
void WorkingMap::insert_place(const MapChange& change) {
  const GatewayIndex here = change.departure;
  const GatewayIndex there = of(here).leads_to;
  CAIRN_CHECK(is_linked(here));
  const GatewayIndex first =
      append_place(change.star, change.visit, places_[place_of(here).index()].component);
  const GatewayIndex arrival = first + change.target;
  const GatewayIndex onward = of(arrival).through;
  CAIRN_CHECK(onward != kNoGateway);
  for (GatewayIndex at = first; at < end_gateway(); ++at) {
    of(at).next = of(at).previous = kNoGateway;
  }
  of(here).leads_to = arrival;
  of(arrival).leads_to = here;
  of(there).leads_to = onward;
  of(onward).leads_to = there;
  path_count_ -= 1;
  pending_count_ -= 2;
  for (GatewayIndex at = first; at < end_gateway(); ++at) {
    if (is_pending(at)) {
      enter_ring(at);
    }
  }
}

void WorkingMap::take_out_place(const MapChange& change) {
  const GatewayIndex here = change.departure;
  const GatewayIndex first = places_.back().first_gateway;
  const GatewayIndex there = of(of(of(here).leads_to).through).leads_to;
  for (GatewayIndex at = end_gateway() - 1; at >= first; --at) {
    if (is_pending(at)) {
      leave_ring(at);
    }
  }
  of(here).leads_to = there;
  of(there).leads_to = here;
  path_count_ += 1;
  pending_count_ += 2;
  remove_last_place();
}

}  // namespace cairn
