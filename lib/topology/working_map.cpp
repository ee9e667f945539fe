#include "topology/working_map.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace cairn {

void WorkingMap::apply(const MapChange& change) {
  switch (change.kind) {
    case MapChange::Kind::kNothing:
      return;
    case MapChange::Kind::kPlace:
      return add_place(change);
    case MapChange::Kind::kLink:
      return link(change.departure, change.target);
    case MapChange::Kind::kStrayPlace:
      return add_stray_place(change);
    case MapChange::Kind::kOneWay:
      of(change.departure).leads_to = change.target;
      leave_ring(change.departure);
      --pending_count_;
      ++one_way_count_;
      return;
    case MapChange::Kind::kOtherStar:
      return change_star(change);
    case MapChange::Kind::kInsertPlace:
      return insert_place(change);
  }
}

void WorkingMap::undo(const MapChange& change) {
  switch (change.kind) {
    case MapChange::Kind::kNothing:
      return;
    case MapChange::Kind::kPlace:
      return remove_place(change);
    case MapChange::Kind::kLink:
      return unlink(change.departure, change.target);
    case MapChange::Kind::kStrayPlace:
      return remove_stray_place(change);
    case MapChange::Kind::kOneWay:
      of(change.departure).leads_to = kNoGateway;
      rejoin_ring(change.departure);
      ++pending_count_;
      --one_way_count_;
      return;
    case MapChange::Kind::kOtherStar:
      return restore_star(change);
    case MapChange::Kind::kInsertPlace:
      return take_out_place(change);
  }
}

std::size_t WorkingMap::bytes() const {
  return gateways_.capacity() * sizeof(Gateway) + places_.capacity() * sizeof(Place) +
         saved_.capacity() * sizeof(Saved) + records_.capacity() * sizeof(VisitRecord);
}

void WorkingMap::record_visit(GatewayIndex position, VisitId visit) {
  Place& place = places_[place_of(position).index()];
  records_.push_back({visit, position - place.first_gateway, place.latest_record});
  place.latest_record = static_cast<std::int32_t>(records_.size()) - 1;
}

void WorkingMap::forget_last_visit(PlaceId place) {
  places_[place.index()].latest_record = records_.back().previous;
  records_.pop_back();
}

// The new gateways form a ring of their own.
GatewayIndex WorkingMap::append_place(StarId star, VisitId visit, std::int32_t component) {
  const auto first = static_cast<GatewayIndex>(gateways_.size());
  const auto place = static_cast<std::int32_t>(places_.size());
  const int count = stars_->gateway_count(star);
  places_.push_back({star, first, component, visit, visit, -1});
  gateways_.resize(gateways_.size() + static_cast<std::size_t>(count));
  for (int number = 0; number < count; ++number) {
    Gateway& gateway = of(first + number);
    gateway.place = place;
    gateway.next = first + (number + 1 == count ? 0 : number + 1);
    gateway.previous = first + (number == 0 ? count - 1 : number - 1);
  }
  fill_from_star(first, star);
  path_count_ += stars_->fragment_count(star);
  pending_count_ += count;
  component_count_ = std::max(component_count_, 1);
  return first;
}

void WorkingMap::fill_from_star(GatewayIndex first, StarId star) {
  const int count = stars_->gateway_count(star);
  for (int number = 0; number < count; ++number) {
    const int through = stars_->through(star, number);
    of(first + number).through = through < 0 ? kNoGateway : first + through;
    of(first + number).view_class = stars_->view_class(star, number).value;
  }
}

void WorkingMap::remove_last_place() {
  const Place& last = places_.back();
  path_count_ -= stars_->fragment_count(last.star);
  pending_count_ -= stars_->gateway_count(last.star);
  gateways_.resize(static_cast<std::size_t>(last.first_gateway));
  places_.pop_back();
}

void WorkingMap::leave_ring(GatewayIndex at) {
  const Gateway& leaving = of(at);
  of(leaving.next).previous = leaving.previous;
  of(leaving.previous).next = leaving.next;
}

void WorkingMap::rejoin_ring(GatewayIndex at) {
  const Gateway& returning = of(at);
  of(returning.next).previous = at;
  of(returning.previous).next = at;
}

// The walk along the new place's walls: where the departing gateway was, its other gateways follow.
void WorkingMap::add_place(const MapChange& change) {
  const GatewayIndex departure = change.departure;
  const GatewayIndex first =
      append_place(change.star, change.visit, places_[place_of(departure).index()].component);
  const GatewayIndex arrival = first + change.target;
  const GatewayIndex begin = of(arrival).next;
  const GatewayIndex end = of(arrival).previous;
  const GatewayIndex before = of(departure).previous;
  const GatewayIndex after = of(departure).next;
  if (begin == arrival) {
    leave_ring(departure);
  } else if (after == departure) {
    leave_ring(arrival);
  } else {
    of(before).next = begin;
    of(begin).previous = before;
    of(end).next = after;
    of(after).previous = end;
  }
  of(departure).leads_to = arrival;
  of(arrival).leads_to = departure;
  path_count_ -= 1;
  pending_count_ -= 2;
}

void WorkingMap::remove_place(const MapChange& change) {
  of(change.departure).leads_to = kNoGateway;
  rejoin_ring(change.departure);
  path_count_ += 1;
  pending_count_ += 2;
  remove_last_place();
}

// A ring d A b B becomes the rings A and B; the rings d A and b B become the ring A B. What is
// alone in its ring leaves nothing behind.
void WorkingMap::link(GatewayIndex a, GatewayIndex b) {
  const Gateway& gateway_a = of(a);
  const Gateway& gateway_b = of(b);
  if (next_component_ > 1) {
    join_components(a, b);
  }
  if (rings_ == Rings::kOne || gateway_a.next == a || gateway_b.next == b) {
    leave_ring(a);
    leave_ring(b);
  } else {
    of(gateway_b.previous).next = gateway_a.next;
    of(gateway_a.next).previous = gateway_b.previous;
    of(gateway_a.previous).next = gateway_b.next;
    of(gateway_b.next).previous = gateway_a.previous;
  }
  of(a).leads_to = b;
  of(b).leads_to = a;
  path_count_ -= 1;
  pending_count_ -= 2;
}

void WorkingMap::unlink(GatewayIndex a, GatewayIndex b) {
  of(a).leads_to = kNoGateway;
  of(b).leads_to = kNoGateway;
  rejoin_ring(b);
  rejoin_ring(a);
  path_count_ += 1;
  pending_count_ += 2;
  if (next_component_ > 1) {
    part_components();
  }
}

}  // namespace cairn
