#include "support/obvious_map.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "star/isomorphism.hpp"

namespace cairn::test {
namespace {

using Index = std::size_t;

/// A place as a path passes it: out of it by the slot `ahead`, into it by the slot `behind`.
struct Stop {
  int place = 0;
  Index ahead = 0;
  Index behind = 0;
};

/// What a traveller meets who leaves by a slot and goes straight on until the path ends, or is back
/// where he left.
std::vector<Stop> met_beyond(const ObviousMap& map, int from, Index slot) {
  std::vector<Stop> met;
  int place = from;
  int gateway = place_of(map, from).star.slots[slot].gateway;
  while (gateway >= 0) {
    const ObviousGateway arrival = across(map, {place, gateway});
    if (arrival.place < 0) {
      break;
    }
    const Star& star = place_of(map, arrival.place).star;
    const Index behind = slot_of_gateway(star, arrival.gateway);
    const Index ahead = star.slots[behind].partner;
    met.push_back({arrival.place, ahead, behind});
    if (arrival.place == from && ahead == slot) {
      break;
    }
    place = arrival.place;
    gateway = star.slots[ahead].gateway;
  }
  return met;
}

using Path = std::vector<Stop>;

/// The whole path through a fragment; a circular one comes back to its first stop.
Path path_through(const ObviousMap& map, int place, Index slot) {
  const Index behind = place_of(map, place).star.slots[slot].partner;
  Path path;
  for (const Stop& stop : met_beyond(map, place, behind)) {
    path.insert(path.begin(), {stop.place, stop.behind, stop.ahead});
  }
  path.push_back({place, slot, behind});
  for (const Stop& stop : met_beyond(map, place, slot)) {
    path.push_back(stop);
  }
  return path;
}

std::set<int> places_on(const Path& path) {
  std::set<int> places;
  for (const Stop& stop : path) {
    places.insert(stop.place);
  }
  return places;
}

std::vector<Path> all_paths(const ObviousMap& map) {
  std::vector<Path> paths;
  std::set<std::pair<int, Index>> seen;
  for (int place = 0; place < static_cast<int>(map.places.size()); ++place) {
    for (Index slot = 0; slot < place_of(map, place).star.slots.size(); ++slot) {
      if (seen.count({place, slot}) == 0) {
        paths.push_back(path_through(map, place, slot));
        for (const Stop& stop : paths.back()) {
          seen.insert({stop.place, stop.ahead});
          seen.insert({stop.place, stop.behind});
        }
      }
    }
  }
  return paths;
}

/// Two paths that share two places.
bool has_double_meeting(const std::vector<std::set<int>>& paths) {
  for (Index a = 0; a < paths.size(); ++a) {
    for (Index b = a + 1; b < paths.size(); ++b) {
      if (common(paths[a], paths[b]).size() >= 2) {
        return true;
      }
    }
  }
  return false;
}

/// Clockwise from the gateway at which the type name begins.
int view_class_of(const Star& star, int gateway) {
  const int count = gateway_count(star);
  int first = 0;
  for (int other = 1; other < count; ++other) {
    first = view_code(star, other) > view_code(star, first) ? other : first;
  }
  int lowest = 0;
  while (!are_alike(star, (first + lowest) % count, star, gateway)) {
    ++lowest;
  }
  return lowest;
}

}  // namespace

const ObviousPlace& place_of(const ObviousMap& map, int place) {
  return map.places[static_cast<Index>(place)];
}
ObviousGateway across(const ObviousMap& map, ObviousGateway at) {
  return place_of(map, at.place).leads_to[static_cast<Index>(at.gateway)];
}
bool is_pending(const ObviousMap& map, ObviousGateway at) {
  return across(map, at).place < 0;
}
ObviousGateway clockwise_of(const ObviousMap& map, ObviousGateway at) {
  const auto count = static_cast<int>(place_of(map, at.place).leads_to.size());
  return {at.place, (at.gateway + 1) % count};
}

std::vector<ObviousGateway> all_gateways(const ObviousMap& map) {
  std::vector<ObviousGateway> all;
  for (int place = 0; place < static_cast<int>(map.places.size()); ++place) {
    for (int gateway = 0; gateway < gateway_count(place_of(map, place).star); ++gateway) {
      all.push_back({place, gateway});
    }
  }
  return all;
}

ObviousGateway departure_of(const ObviousMap& map, int turn) {
  const int count = gateway_count(place_of(map, map.robot.place).star);
  return {map.robot.place, (map.robot.gateway + turn) % count};
}

ObviousMap first_map(const Exploration& exploration) {
  ObviousMap map;
  add_place(&map, exploration.start);
  map.robot = {0, exploration.start_gateway};
  return map;
}

void link(ObviousMap* map, ObviousGateway a, ObviousGateway b) {
  map->places[static_cast<Index>(a.place)].leads_to[static_cast<Index>(a.gateway)] = b;
  map->places[static_cast<Index>(b.place)].leads_to[static_cast<Index>(b.gateway)] = a;
  map->robot = b;
}

void add_place(ObviousMap* map, const Star& star) {
  map->places.push_back(
      {star, std::vector<ObviousGateway>(static_cast<Index>(gateway_count(star)))});
}

std::set<int> common(const std::set<int>& a, const std::set<int>& b) {
  std::set<int> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  return both;
}

std::vector<std::set<int>> places_of_paths(const ObviousMap& map) {
  std::vector<std::set<int>> places;
  for (const Path& path : all_paths(map)) {
    places.push_back(places_on(path));
  }
  return places;
}

bool is_closed(const ObviousMap& map) {
  const std::vector<ObviousGateway> all = all_gateways(map);
  return std::none_of(all.begin(), all.end(),
                      [&map](ObviousGateway at) { return is_pending(map, at); });
}

bool has_triangle(const ObviousMap& map) {
  const std::vector<std::set<int>> paths = places_of_paths(map);
  for (Index a = 0; a < paths.size(); ++a) {
    for (Index b = a + 1; b < paths.size(); ++b) {
      const std::set<int> ab = common(paths[a], paths[b]);
      for (Index c = b + 1; c < paths.size() && !ab.empty(); ++c) {
        if (!common(paths[a], paths[c]).empty() && !common(paths[b], paths[c]).empty() &&
            common(ab, paths[c]).empty()) {
          return true;
        }
      }
    }
  }
  return false;
}

bool is_perpendicular(const ObviousMap& map) {
  return !has_double_meeting(places_of_paths(map)) && !has_triangle(map);
}

bool repeats_a_place(const ObviousMap& map, ObviousGateway on_it) {
  const Index slot = slot_of_gateway(place_of(map, on_it.place).star, on_it.gateway);
  const Path path = path_through(map, on_it.place, slot);
  return places_on(path).size() < path.size();
}

bool is_region_consistent(const ObviousMap& map) {
  for (const Path& path : all_paths(map)) {
    std::set<int> left;
    std::set<int> right;
    for (const Stop& stop : path) {
      const Index size = place_of(map, stop.place).star.slots.size();
      for (Index slot = 0; slot < size; ++slot) {
        if (slot != stop.ahead && slot != stop.behind) {
          const bool is_right =
              (slot + size - stop.ahead) % size < (stop.behind + size - stop.ahead) % size;
          for (const Stop& beyond : met_beyond(map, stop.place, slot)) {
            (is_right ? right : left).insert(beyond.place);
          }
        }
      }
    }
    const std::set<int> on = places_on(path);
    if (!common(left, right).empty() || !common(on, left).empty() || !common(on, right).empty()) {
      return false;
    }
  }
  return true;
}

ObviousMap obvious_map(const Exploration& exploration, const std::vector<ObviousGateway>& visits) {
  ObviousMap map = first_map(exploration);
  map.robot = visits.front();
  for (Index step = 0; step < exploration.steps.size(); ++step) {
    const ObviousGateway from = departure_of(map, exploration.steps[step].turn);
    const ObviousGateway to = visits[step + 1];
    if (to.place == static_cast<int>(map.places.size())) {
      add_place(&map, exploration.steps[step].star);
    }
    link(&map, from, to);
  }
  return map;
}

std::string obvious_code(const ObviousMap& map) {
  std::vector<ObviousGateway> met{map.robot};  // Places by number, with the gateway of entry.
  const auto number_of = [&met](ObviousGateway at) {
    const auto known = std::find_if(met.begin(), met.end(),
                                    [at](ObviousGateway entry) { return entry.place == at.place; });
    const auto number = known - met.begin();
    if (known == met.end()) {
      met.push_back(at);
    }
    return static_cast<int>(number);
  };
  std::string code;
  for (Index next = 0; next < met.size(); ++next) {
    const ObviousGateway entry = met[next];
    const Star& star = place_of(map, entry.place).star;
    code += type_name(star) + std::to_string(view_class_of(star, entry.gateway)) + "[";
    ObviousGateway at = entry;
    do {
      code += at == entry ? "" : " ";
      if (is_pending(map, at)) {
        code += "-";
      } else {
        const ObviousGateway to = across(map, at);
        const auto number = static_cast<Index>(number_of(to));
        const int count = gateway_count(place_of(map, to.place).star);
        code += std::to_string(number) + "." +
                std::to_string((to.gateway - met[number].gateway + count) % count);
      }
      at = clockwise_of(map, at);
    } while (at != entry);
    code += "]";
  }
  return code;
}

}  // namespace cairn::test
