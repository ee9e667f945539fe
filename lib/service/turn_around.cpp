#include "service/turn_around.hpp"

#include <algorithm>
#include <vector>

#include "place/gateway.hpp"

namespace cairn {
namespace {

/// The gateway of the visit before that is this one; -1 if none.
int number_before(const PlaceVisit& before, const PlaceVisit& visit, int gateway) {
  const Gateway seen = transformed(before.T_lpm_place.inverse() * visit.T_lpm_place,
                                   visit.neighbourhood.gateways[static_cast<std::size_t>(gateway)]);
  const std::vector<Gateway>& known = before.neighbourhood.gateways;
  const auto same = std::find_if(known.begin(), known.end(), [&](const Gateway& other) {
    return is_same_gateway(other, seen);
  });
  return same != known.end() ? static_cast<int>(same - known.begin()) : -1;
}

}  // namespace

std::optional<int> departure_after_turning_around(const PlaceVisit& before,
                                                  const PlaceVisit& visit,
                                                  double within_m) {
  const double apart_m =
      (before.T_lpm_place.translation() - visit.T_lpm_place.translation()).norm();
  if (apart_m >= within_m || before.departure_gateway < 0 || visit.arrival_gateway < 0 ||
      number_before(before, visit, visit.arrival_gateway) != before.departure_gateway) {
    return std::nullopt;
  }
  if (visit.departure_gateway < 0) {
    return -1;
  }
  // Both saw as many gateways: they follow each other, however far out each was read.
  const int count = static_cast<int>(before.neighbourhood.gateways.size());
  if (count == static_cast<int>(visit.neighbourhood.gateways.size())) {
    const int turn = visit.departure_gateway - visit.arrival_gateway + count;
    return (before.departure_gateway + turn) % count;
  }
  const int departure = number_before(before, visit, visit.departure_gateway);
  return departure >= 0 ? std::optional(departure) : std::nullopt;
}

}  // namespace cairn
