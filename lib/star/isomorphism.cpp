#include "star/isomorphism.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace cairn {
namespace {

std::string text_of(const ViewCode& code) {
  std::string text;
  for (const int slot : code) {
    text += (slot % 2 == 1 ? "g" : "x") + std::to_string(slot / 2);
  }
  return text;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kNamedTypes = {{
    {"g1x1", "D"},
    {"g1g1", "I"},
    {"g2g2x2x2", "L"},
    {"g2g2g2x2", "T"},
    {"g2g2g2g2", "+"},
}};

}  // namespace

ViewCode view_code(const Star& star, int gateway) {
  const std::size_t size = star.slots.size();
  const std::size_t first = slot_of_gateway(star, gateway);
  ViewCode code;
  code.reserve(size);
  for (std::size_t step = 0; step < size; ++step) {
    const std::size_t slot = (first + step) % size;
    const std::size_t clockwise_to_partner = (star.slots[slot].partner + size - slot) % size;
    const int leaves = star.slots[slot].gateway >= 0 ? 1 : 0;
    code.push_back(2 * static_cast<int>(clockwise_to_partner) + leaves);
  }
  return code;
}

bool are_alike(const Star& star_a, int gateway_a, const Star& star_b, int gateway_b) {
  return view_code(star_a, gateway_a) == view_code(star_b, gateway_b);
}

std::vector<int> view_classes(const Star& star) {
  std::vector<int> classes;
  for (int gateway = 0; gateway < gateway_count(star); ++gateway) {
    int lowest = 0;
    while (!are_alike(star, gateway, star, lowest)) {
      ++lowest;
    }
    classes.push_back(lowest);
  }
  return classes;
}

std::string type_name(const Star& star) {
  // The greatest rotation, so that gateways come first and ends last.
  ViewCode canonical;
  for (int gateway = 0; gateway < gateway_count(star); ++gateway) {
    canonical = std::max(canonical, view_code(star, gateway));
  }
  std::string code = text_of(canonical);
  for (const auto& [known_code, name] : kNamedTypes) {
    if (code == known_code) {
      return std::string(name);
    }
  }
  return code;
}

}  // namespace cairn
