#include "star/star_edits.hpp"

namespace cairn {
namespace {

/// The star without the two slots of one fragment.
Star without_fragment(const Star& star, std::size_t slot) {
  const std::size_t partner = star.slots[slot].partner;
  const auto slots_before = [slot, partner](std::size_t position) {
    return static_cast<std::size_t>(slot < position) + static_cast<std::size_t>(partner < position);
  };
  Star rest;
  rest.slots.reserve(star.slots.size());
  for (std::size_t position = 0; position < star.slots.size(); ++position) {
    if (position != slot && position != partner) {
      rest.slots.push_back(star.slots[position]);
      rest.slots.back().partner -= slots_before(rest.slots.back().partner);
    }
  }
  return rest;
}

void insert_slot(Star* star, std::size_t at, const StarSlot& slot) {
  for (StarSlot& other : star->slots) {
    other.partner += other.partner >= at ? 1 : 0;
  }
  star->slots.insert(star->slots.begin() + static_cast<std::ptrdiff_t>(at), slot);
}

}  // namespace

std::optional<Star> without_gateway(const Star& star, int gateway) {
  const std::size_t slot = slot_of_gateway(star, gateway);
  if (gateway_count(star) == 1) {
    return std::nullopt;
  }
  const bool is_alone = star.slots[star.slots[slot].partner].gateway < 0;
  Star rest = is_alone ? without_fragment(star, slot) : star;
  if (!is_alone) {
    rest.slots[slot].gateway = -1;
    rest.slots[slot].law = ControlLaw::kDeadEnd;
  }
  for (StarSlot& other : rest.slots) {
    other.gateway -= other.gateway > gateway ? 1 : 0;
  }
  return rest;
}

Star with_gateway(const Star& star, int number) {
  const std::size_t half = star.slots.size() / 2;
  std::size_t at = number < gateway_count(star) ? slot_of_gateway(star, number) : star.slots.size();
  const std::size_t opposite = at <= half ? at + half + 1 : at - half;
  Star more = star;
  for (StarSlot& slot : more.slots) {
    slot.gateway += slot.gateway >= number ? 1 : 0;
  }
  insert_slot(&more, at, {number, 0, ControlLaw::kMidline});
  insert_slot(&more, opposite, {-1, 0, ControlLaw::kDeadEnd});
  at += opposite <= at ? 1 : 0;
  more.slots[at].partner = opposite;
  more.slots[opposite].partner = at;
  return more;
}

Star rotated_to(const Star& star, int first_gateway) {
  const std::size_t first_slot = slot_of_gateway(star, first_gateway);
  const std::size_t size = star.slots.size();
  const int gateways = gateway_count(star);
  Star rotated;
  rotated.slots.reserve(size);
  for (std::size_t step = 0; step < size; ++step) {
    StarSlot slot = star.slots[(first_slot + step) % size];
    slot.partner = (slot.partner + size - first_slot) % size;
    if (slot.gateway >= 0) {
      slot.gateway = (slot.gateway + gateways - first_gateway) % gateways;
    }
    rotated.slots.push_back(slot);
  }
  return rotated;
}

}  // namespace cairn
