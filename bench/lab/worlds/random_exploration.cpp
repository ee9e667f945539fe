#include "bench/lab/worlds/random_exploration.hpp"

#include <algorithm>
#include <map>

#include "bench/lab/worlds/random_world.hpp"
#include "exact_search/exact_search.hpp"

namespace cairn::lab {

Walk random_exploration(std::uint64_t seed, std::int64_t most_nodes) {
  RandomSource random(seed, 3);
  RandomWorldOptions world_options;
  RandomWalkOptions walk_options;
  world_options.star_kinds = 1 + random.below(4);
  world_options.closing_probability = 0.2 + 0.7 * random.uniform();
  walk_options.turning_back_probability = random.chance(0.5) ? 0.1 : 0.0;
  if (random.chance(0.5)) {
    // Small enough to be known completely in the end.
    world_options.places = 1 + random.below(5);
    walk_options.travels = 8 + random.below(17);
    walk_options.exploring_probability = 1.0;
  } else {
    world_options.places = 4 + random.below(12);
    walk_options.travels = 4 + random.below(17);
    walk_options.exploring_probability = random.uniform();
  }
  Walk walk = random_walk(random_world(world_options, seed), walk_options, seed);

  // A longer walk only makes a larger tree.
  ExactSearchOptions options;
  options.max_nodes = most_nodes;
  while (!enumerate(walk.exploration, options).is_complete) {
    walk.exploration.steps.pop_back();
    walk.visits.pop_back();
  }
  return walk;
}

std::vector<TrueStep> truth_of(const Walk& walk) {
  struct Met {
    int number = 0;
    std::vector<int> gateways;  // As TrueVisit::gateways of the first visit.
  };
  std::map<int, Met> met;
  std::vector<TrueStep> truth;
  for (std::size_t visit = 0; visit < walk.visits.size(); ++visit) {
    const TrueVisit& seen = walk.visits[visit];
    const int number = static_cast<int>(met.size());
    const Met& place = met.emplace(seen.place, Met{number, seen.gateways}).first->second;
    const int arrival = visit == 0 ? walk.exploration.start_gateway
                                   : walk.exploration.steps[visit - 1].arrival_gateway;
    const auto known = std::find(place.gateways.begin(), place.gateways.end(),
                                 seen.gateways[static_cast<std::size_t>(arrival)]);
    truth.push_back({place.number, static_cast<int>(known - place.gateways.begin())});
  }
  return truth;
}

}  // namespace cairn::lab
