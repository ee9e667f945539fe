#include "bench/lab/worlds/world.hpp"

#include <algorithm>
#include <set>

namespace cairn::lab {
namespace {

using Index = std::size_t;

const WorldPlace& place_of(const World& world, WorldGateway at) {
  return world.places[static_cast<Index>(at.place)];
}

WorldGateway across(const World& world, WorldGateway at) {
  return place_of(world, at).leads_to[static_cast<Index>(at.gateway)];
}

bool is_symmetric(const World& world) {
  for (int place = 0; place < static_cast<int>(world.places.size()); ++place) {
    const WorldPlace& here = world.places[static_cast<Index>(place)];
    for (int gateway = 0; gateway < static_cast<int>(here.leads_to.size()); ++gateway) {
      const WorldGateway from{place, gateway};
      const WorldGateway to = across(world, from);
      if (to == from || across(world, to) != from) {
        return false;
      }
    }
  }
  return true;
}

/// Whether a traveller who leaves here and always goes straight on comes to no place twice.
bool goes_straight_to_an_end(const World& world, WorldGateway departure) {
  std::set<int> met{departure.place};
  std::optional<int> gateway = departure.gateway;
  for (WorldGateway at = departure; gateway;
       gateway = through_partner(place_of(world, at).star, at.gateway)) {
    at = across(world, {at.place, *gateway});
    if (!met.insert(at.place).second) {
      return false;
    }
  }
  return true;
}

std::vector<WorldGateway> all_gateways(const World& world) {
  std::vector<WorldGateway> all;
  for (int place = 0; place < static_cast<int>(world.places.size()); ++place) {
    const WorldPlace& here = world.places[static_cast<Index>(place)];
    for (int gateway = 0; gateway < static_cast<int>(here.leads_to.size()); ++gateway) {
      all.push_back({place, gateway});
    }
  }
  return all;
}

}  // namespace

bool satisfies_axioms(const World& world) {
  if (!is_symmetric(world)) {
    return false;
  }
  // From one of its ends, or from anywhere on a circular one, a walk along a path meets all of its
  // places.
  const std::vector<WorldGateway> gateways = all_gateways(world);
  return std::all_of(gateways.begin(), gateways.end(), [&world](WorldGateway departure) {
    return goes_straight_to_an_end(world, departure);
  });
}

bool is_planar(const World& world) {
  const std::vector<WorldGateway> gateways = all_gateways(world);
  std::set<WorldGateway> walked;
  std::size_t faces = 0;
  for (const WorldGateway first : gateways) {
    if (walked.count(first) != 0) {
      continue;
    }
    ++faces;
    for (WorldGateway at = first; walked.insert(at).second;) {
      const WorldGateway arrival = across(world, at);
      const int count = static_cast<int>(place_of(world, arrival).leads_to.size());
      at = {arrival.place, (arrival.gateway + 1) % count};
    }
  }
  return world.places.size() + faces == gateways.size() / 2 + 2;
}

Walk walk_through(const World& world, WorldGateway start, const std::vector<int>& departures) {
  const auto seen = [&world](int place) {
    TrueVisit visit{place, {}, false, 0, 0};
    for (Index gateway = 0; gateway < world.places[static_cast<Index>(place)].leads_to.size();
         ++gateway) {
      visit.gateways.push_back(static_cast<int>(gateway));
    }
    return visit;
  };
  Walk walk;
  walk.exploration.start = place_of(world, start).star;
  walk.exploration.start_gateway = start.gateway;
  walk.visits.push_back(seen(start.place));
  WorldGateway at = start;
  for (const int departure : departures) {
    const int count = static_cast<int>(place_of(world, at).leads_to.size());
    const int turn = (departure - at.gateway + count) % count;
    at = across(world, {at.place, departure});
    walk.exploration.steps.push_back({turn, place_of(world, at).star, at.gateway});
    walk.visits.push_back(seen(at.place));
  }
  return walk;
}

}  // namespace cairn::lab
