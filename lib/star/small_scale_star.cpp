#include "star/small_scale_star.hpp"

#include "base/check.hpp"

namespace cairn {
namespace {

std::string gateways_text(const Star& star, std::size_t slot, const SlotNames& names) {
  const auto gateway_text = [&](int gateway, const char* direction) {
    return "(gw" + std::to_string(names.gateway[static_cast<std::size_t>(gateway)]) + "," +
           direction + ")";
  };
  const int outward = star.slots[slot].gateway;
  const int inward = star.slots[star.slots[slot].partner].gateway;
  std::string text = outward >= 0 ? gateway_text(outward, "out") : "";
  if (inward >= 0) {
    text += (text.empty() ? "" : " & ") + gateway_text(inward, "in");
  }
  return text;
}

}  // namespace

SlotNames names_from(const Star& star, std::size_t first_slot) {
  const std::size_t size = star.slots.size();
  CAIRN_CHECK(first_slot < size);
  SlotNames names;
  names.fragment.assign(size, 0);
  names.is_plus.assign(size, false);
  names.gateway.assign(static_cast<std::size_t>(gateway_count(star)), 0);
  int fragments = 0;
  int gateways = 0;
  for (std::size_t step = 0; step < size; ++step) {
    const std::size_t slot = (first_slot + step) % size;
    if (names.fragment[slot] == 0) {
      names.fragment[slot] = ++fragments;
      names.fragment[star.slots[slot].partner] = fragments;
      names.is_plus[slot] = true;
    }
    if (const int gateway = star.slots[slot].gateway; gateway >= 0) {
      names.gateway[static_cast<std::size_t>(gateway)] = ++gateways;
    }
  }
  return names;
}

std::string small_scale_text(const Star& star, std::size_t first_slot) {
  const SlotNames names = names_from(star, first_slot);
  std::string text = "(";
  for (std::size_t step = 0; step < star.slots.size(); ++step) {
    const std::size_t slot = (first_slot + step) % star.slots.size();
    text += step == 0 ? "" : ",\n";
    text += "(PF" + std::to_string(names.fragment[slot]) + (names.is_plus[slot] ? "+" : "-") +
            ", " + gateways_text(star, slot, names) + ", " +
            std::string(name_of(star.slots[slot].law)) + ")";
  }
  return text + ")";
}

}  // namespace cairn
