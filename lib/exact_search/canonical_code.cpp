#include <algorithm>
#include <string>
#include <vector>

#include "exact_search/exact_search.hpp"
#include "star/isomorphism.hpp"

namespace cairn {
namespace {

/// Gateways are numbered from the one that begins the star's greatest view code, so that the number
/// of a view does not depend on the slot at which a star's list begins.
int number_of_view(const Star& star, int gateway) {
  const int count = gateway_count(star);
  std::vector<ViewCode> codes;
  for (int other = 0; other < count; ++other) {
    codes.push_back(view_code(star, other));
  }
  const auto first = static_cast<int>(std::max_element(codes.begin(), codes.end()) - codes.begin());
  int number = 0;
  while (codes[static_cast<std::size_t>((first + number) % count)] !=
         codes[static_cast<std::size_t>(gateway)]) {
    ++number;
  }
  return number;
}

}  // namespace

std::string canonical_code(const TopologicalMap& map) {
  std::vector<GatewayRef> met = {map.position()};  // Places in order, each with its entry.
  std::vector<int> number(static_cast<std::size_t>(map.place_count()), -1);
  number[met.front().place.index()] = 0;
  std::string code;
  for (std::size_t next = 0; next < met.size(); ++next) {
    const GatewayRef entry = met[next];
    const Star& star = map.star(entry.place);
    code += type_name(star) + std::to_string(number_of_view(star, entry.gateway)) + "[";
    const int count = map.gateway_count(entry.place);
    for (int offset = 0; offset < count; ++offset) {
      code += offset > 0 ? " " : "";
      const auto other = map.linked_to({entry.place, (entry.gateway + offset) % count});
      if (!other) {
        code += "-";
        continue;
      }
      int& other_number = number[other->place.index()];
      if (other_number < 0) {
        other_number = static_cast<int>(met.size());
        met.push_back(*other);
      }
      const int others = map.gateway_count(other->place);
      const int entered = met[static_cast<std::size_t>(other_number)].gateway;
      const int turn = (other->gateway - entered + others) % others;
      code += std::to_string(other_number) + "." + std::to_string(turn);
    }
    code += "]";
  }
  return code;
}

}  // namespace cairn
