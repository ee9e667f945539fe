#include <algorithm>
#include <set>

#include "base/validator.hpp"
#include "bench/lab/worlds/random_world.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

/// The star with its gateways numbered from a later slot on.
Star rotated(const Star& star, Index first_slot) {
  const Index size = star.slots.size();
  Star turned;
  int next = 0;
  for (Index step = 0; step < size; ++step) {
    StarSlot slot = star.slots[(first_slot + step) % size];
    slot.partner = (slot.partner + size - first_slot) % size;
    slot.gateway = slot.gateway < 0 ? -1 : next++;
    turned.slots.push_back(slot);
  }
  return turned;
}

void renumber(Star* star, int* arrival, TrueVisit* visit, RandomSource& random) {
  const auto first = static_cast<Index>(random.below(static_cast<int>(star->slots.size())));
  const int count = gateway_count(*star);
  int skipped = 0;
  for (Index slot = 0; slot < first; ++slot) {
    skipped += star->slots[slot].gateway >= 0 ? 1 : 0;
  }
  *star = rotated(*star, first);
  *arrival = (*arrival + count - skipped % count) % count;
  std::rotate(visit->gateways.begin(), visit->gateways.begin() + skipped % count,
              visit->gateways.end());
}

/// A gateway to leave by.
int departure_of(const World& world,
                 WorldGateway at,
                 const std::set<WorldGateway>& known,
                 const RandomWalkOptions& options,
                 RandomSource& random) {
  const int count = static_cast<int>(world.places[static_cast<Index>(at.place)].leads_to.size());
  if (count == 1 || random.chance(options.turning_back_probability)) {
    return at.gateway;
  }
  std::vector<int> onward;
  std::vector<int> unknown;
  for (int gateway = 0; gateway < count; ++gateway) {
    if (gateway != at.gateway) {
      onward.push_back(gateway);
      if (known.count({at.place, gateway}) == 0) {
        unknown.push_back(gateway);
      }
    }
  }
  const bool explores = !unknown.empty() && random.chance(options.exploring_probability);
  const std::vector<int>& choices = explores ? unknown : onward;
  return choices[static_cast<Index>(random.below(static_cast<int>(choices.size())))];
}

}  // namespace

Status validate(const RandomWalkOptions& options) {
  return Validator("random walk")
      .within("travels", options.travels, 0, 1'000'000)
      .within("turning_back_probability", options.turning_back_probability, 0.0, 1.0)
      .within("exploring_probability", options.exploring_probability, 0.0, 1.0)
      .status();
}

Walk random_walk(const World& world, const RandomWalkOptions& options, std::uint64_t seed) {
  RandomSource random(seed, 1);
  const int place = random.below(static_cast<int>(world.places.size()));
  const WorldPlace& first = world.places[static_cast<Index>(place)];
  const WorldGateway start{place, random.below(static_cast<int>(first.leads_to.size()))};

  std::vector<int> departures;
  std::set<WorldGateway> known;
  WorldGateway at = start;
  for (int travel = 0; travel < options.travels; ++travel) {
    departures.push_back(departure_of(world, at, known, options, random));
    const WorldGateway from{at.place, departures.back()};
    at = world.places[static_cast<Index>(from.place)].leads_to[static_cast<Index>(from.gateway)];
    known.insert({from, at});
  }
  Walk walk = walk_through(world, start, departures);
  if (options.renumbered) {
    Exploration& exploration = walk.exploration;
    renumber(&exploration.start, &exploration.start_gateway, &walk.visits.front(), random);
    for (Index step = 0; step < exploration.steps.size(); ++step) {
      ExplorationStep& seen = exploration.steps[step];
      renumber(&seen.star, &seen.arrival_gateway, &walk.visits[step + 1], random);
    }
  }
  return walk;
}

}  // namespace cairn::lab
