#include "star/star.hpp"

#include <string>

#include "base/check.hpp"

namespace cairn {
namespace {

Error invalid(const std::string& what) {
  return Error{ErrorCode::kInvalidValue, "star: " + what};
}

Status validate_fragment(const Star& star, std::size_t slot) {
  const StarSlot& here = star.slots[slot];
  const std::string name = "slot " + std::to_string(slot);
  if (here.partner >= star.slots.size() || here.partner == slot) {
    return invalid(name + " must have another slot as its partner, has " +
                   std::to_string(here.partner));
  }
  const StarSlot& other = star.slots[here.partner];
  if (other.partner != slot) {
    return invalid(name + " is not the partner of its partner");
  }
  if (here.gateway < 0 && other.gateway < 0) {
    return invalid(name + " and its partner make a fragment without a gateway");
  }
  return {};
}

}  // namespace

Status validate(const Star& star) {
  int next_gateway = 0;
  for (std::size_t slot = 0; slot < star.slots.size(); ++slot) {
    const int gateway = star.slots[slot].gateway;
    if (gateway != -1 && gateway != next_gateway) {
      return invalid("slot " + std::to_string(slot) + " must have gateway " +
                     std::to_string(next_gateway) + " or -1, has " + std::to_string(gateway));
    }
    next_gateway += gateway == -1 ? 0 : 1;
    if (Status status = validate_fragment(star, slot); !status) {
      return status;
    }
  }
  return next_gateway > 0 ? Status() : invalid("a place must have a gateway");
}

int gateway_count(const Star& star) {
  int count = 0;
  for (const StarSlot& slot : star.slots) {
    count += slot.gateway >= 0 ? 1 : 0;
  }
  return count;
}

std::size_t slot_of_gateway(const Star& star, int gateway) {
  CAIRN_CHECK(gateway >= 0);
  for (std::size_t slot = 0; slot < star.slots.size(); ++slot) {
    if (star.slots[slot].gateway == gateway) {
      return slot;
    }
  }
  CAIRN_CHECK(!"the star has no such gateway");
  return 0;
}

std::optional<int> through_partner(const Star& star, int gateway) {
  const StarSlot& slot = star.slots[slot_of_gateway(star, gateway)];
  const int partner = star.slots[slot.partner].gateway;
  return partner < 0 ? std::nullopt : std::optional(partner);
}

std::string_view name_of(ControlLaw law) {
  switch (law) {
    case ControlLaw::kMidline:
      return "MIDLINE";
    case ControlLaw::kLeftWall:
      return "LEFTWALL";
    case ControlLaw::kRightWall:
      return "RIGHTWALL";
    case ControlLaw::kDeadEnd:
      return "DEADEND";
    case ControlLaw::kNone:
      return "NONE";
  }
  CAIRN_CHECK(!"a control law outside of its enumeration");
  return "";
}

}  // namespace cairn
