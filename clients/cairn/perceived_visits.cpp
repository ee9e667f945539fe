#include "clients/cairn/perceived_visits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "clients/common/failure.hpp"
#include "clients/common/progress.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::perceived_place_t;

perceived_place_t seen_at(MapSource& source, std::int64_t visit, std::int64_t place) {
  perceived_place_t perceived = source.perceived_place(visit);
  perceived.place_id = place;
  return perceived;
}

std::vector<std::int64_t> visits_to(const cairn_lcm::visit_places_t& visits, std::int64_t place) {
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < visits.place_id.size(); ++i) {
    if (visits.place_id[i] == place) {
      numbers.push_back(static_cast<std::int64_t>(i));
    }
  }
  return numbers;
}

}  // namespace

bool is_shown_by(const cairn_lcm::place_t& place, const perceived_place_t& perceived) {
  constexpr double kSame_m = 1e-3;
  return std::all_of(
      place.gateways.begin(), place.gateways.end(), [&](const cairn_lcm::gateway_t& gateway) {
        return std::any_of(perceived.openings.begin(), perceived.openings.end(),
                           [&](const cairn_lcm::opening_t& one) {
                             return std::hypot(one.x_m - gateway.x_m, one.y_m - gateway.y_m) <
                                    kSame_m;
                           });
      });
}

std::vector<perceived_place_t> shown_visits(MapSource& source,
                                            const cairn_lcm::topology_t& topology) {
  const cairn_lcm::visit_places_t visits = source.visit_places();
  Progress progress("looking up places");
  std::vector<perceived_place_t> shown;
  for (const cairn_lcm::place_t& place : topology.places) {
    std::optional<perceived_place_t> best;
    for (const std::int64_t visit : visits_to(visits, place.id)) {
      perceived_place_t perceived = seen_at(source, visit, place.id);
      const bool is_shown = is_shown_by(place, perceived);
      if (!best || is_shown) {
        best = std::move(perceived);
      }
      if (is_shown) {
        break;
      }
    }
    if (best) {
      shown.push_back(*std::move(best));
    }
    progress.show(static_cast<std::int64_t>(shown.size()),
                  static_cast<std::int64_t>(topology.places.size()));
  }
  return shown;
}

std::vector<perceived_place_t> all_visits(MapSource& source) {
  const cairn_lcm::visit_places_t visits = source.visit_places();
  Progress progress("looking up visits");
  std::vector<perceived_place_t> all;
  for (std::size_t i = 0; i < visits.place_id.size(); ++i) {
    all.push_back(seen_at(source, static_cast<std::int64_t>(i), visits.place_id[i]));
    progress.show(static_cast<std::int64_t>(i) + 1,
                  static_cast<std::int64_t>(visits.place_id.size()));
  }
  return all;
}

}  // namespace cairn::clients
