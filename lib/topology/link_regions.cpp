#include "topology/link_regions.hpp"

#include <algorithm>
#include <utility>

namespace cairn {
namespace {

constexpr std::uint64_t kOn = 0;
constexpr std::uint64_t kRight = 1;
constexpr std::uint64_t kLeft = 2;

}  // namespace

bool LinkRegions::stay_consistent(GatewayIndex a, GatewayIndex b) {
  a_ = a;
  b_ = b;
  side_.resize(std::max(side_.size(), static_cast<std::size_t>(map_->place_count())), 0);
  const Stop start = stop_entered_by(a);
  joined_.assign(1, {start.place, start.backward_slot, start.forward_slot});
  follow(start.place, start.backward_slot, true, &joined_);
  follow(start.place, start.forward_slot, false, &joined_);
  if (!divides(joined_)) {
    return false;
  }
  for (const Stop& stop : joined_) {
    const std::vector<StarSlot>& slots = star(stop.place).slots;
    for (std::size_t slot = 0; slot < slots.size(); ++slot) {
      if (slot == stop.forward_slot || slot == stop.backward_slot || slots[slot].partner < slot) {
        continue;
      }
      crossing_.assign(1, {stop.place, slot, slots[slot].partner});
      follow(stop.place, slot, true, &crossing_);
      follow(stop.place, slots[slot].partner, false, &crossing_);
      if (!divides(crossing_)) {
        return false;
      }
    }
  }
  return true;
}

// Paths end where a gateway leads one way only: following it might never come to an end.
GatewayIndex LinkRegions::leads_to(GatewayIndex at) const {
  if (at == a_) {
    return b_;
  }
  if (at == b_) {
    return a_;
  }
  const GatewayIndex end = map_->leads_to(at);
  return end != kNoGateway && map_->leads_to(end) == at ? end : kNoGateway;
}

LinkRegions::Stop LinkRegions::stop_entered_by(GatewayIndex entry) const {
  const PlaceId place = map_->place_of(entry);
  const std::size_t slot = map_->stars().slot_of(map_->star(place), map_->number_of(entry));
  return {place, star(place).slots[slot].partner, slot};
}

GatewayIndex LinkRegions::exit_of(PlaceId place, std::size_t slot) const {
  const int number = star(place).slots[slot].gateway;
  return number < 0 ? kNoGateway : map_->first_gateway(place) + number;
}

/// Lists the stops that lie beyond a slot of a place.
void LinkRegions::follow(PlaceId place,
                         std::size_t slot,
                         bool forward,
                         std::vector<Stop>* stops) const {
  GatewayIndex exit = exit_of(place, slot);
  while (exit != kNoGateway) {
    const GatewayIndex entry = leads_to(exit);
    if (entry == kNoGateway) {
      return;
    }
    Stop stop = stop_entered_by(entry);
    exit = map_->through(entry);
    if (!forward) {
      std::swap(stop.forward_slot, stop.backward_slot);
    }
    stops->push_back(stop);
  }
}

bool LinkRegions::divides(const std::vector<Stop>& stops) {
  ++now_;
  for (const Stop& stop : stops) {
    side_[stop.place.index()] = 4 * now_ + kOn;
  }
  return std::all_of(stops.begin(), stops.end(),
                     [&](const Stop& stop) { return marks_around(stop); });
}

bool LinkRegions::marks_around(const Stop& stop) {
  const std::size_t slots = star(stop.place).slots.size();
  std::uint64_t side = kRight;
  std::size_t slot = stop.forward_slot;
  for (std::size_t step = 1; step < slots; ++step) {
    slot = slot + 1 == slots ? 0 : slot + 1;
    if (slot == stop.backward_slot) {
      side = kLeft;
    } else if (!marks_outward(stop.place, slot, side)) {
      return false;
    }
  }
  return true;
}

bool LinkRegions::marks_outward(PlaceId place, std::size_t slot, std::uint64_t side) {
  const std::uint64_t mark = 4 * now_ + side;
  GatewayIndex exit = exit_of(place, slot);
  while (exit != kNoGateway) {
    const GatewayIndex entry = leads_to(exit);
    if (entry == kNoGateway) {
      return true;
    }
    std::uint64_t& known = side_[map_->place_of(entry).index()];
    if (known >= 4 * now_ && known != mark) {
      return false;
    }
    known = mark;
    exit = map_->through(entry);
  }
  return true;
}

}  // namespace cairn
