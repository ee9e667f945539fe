#include "exact_search/replay.hpp"

#include <memory>

namespace cairn {

TopologicalMap replay(const ObservedWalk& walk, const std::vector<MapChange>& changes) {
  TopologicalMap map(std::make_shared<const StarCatalogue>(walk.stars()),
                     {walk.start(), walk.start_gateway(), VisitId{0}});
  std::vector<GatewayRef> gateways;  // By GatewayIndex.
  const auto list_gateways_of = [&](PlaceId place) {
    for (int number = 0; number < map.gateway_count(place); ++number) {
      gateways.push_back({place, number});
    }
  };
  list_gateways_of(PlaceId{0});
  int number = 0;
  for (const MapChange& change : changes) {
    const ObservedStep& step = walk.step(number++);
    const Arrival arrival{step.star, step.arrival_gateway, VisitId{number}};
    const GatewayRef departure = map.departure({step.turn});
    if (change.kind == MapChange::Kind::kNothing) {
      map.follow(departure, arrival);
    } else if (change.kind == MapChange::Kind::kLink) {
      map.close(departure, gateways[static_cast<std::size_t>(change.target)], arrival);
    } else {
      map.add_place(departure, arrival);
      list_gateways_of(map.position().place);
    }
  }
  return map;
}

}  // namespace cairn
