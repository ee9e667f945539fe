#include "bench/lab/worlds/random_world.hpp"

#include <algorithm>
#include <set>

#include "base/validator.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

Star star_of(const std::vector<bool>& leaves, const std::vector<Index>& partners) {
  Star star;
  int next = 0;
  for (Index slot = 0; slot < leaves.size(); ++slot) {
    const ControlLaw law = leaves[slot] ? ControlLaw::kMidline : ControlLaw::kDeadEnd;
    star.slots.push_back({leaves[slot] ? next++ : -1, partners[slot], law});
  }
  return star;
}

/// Fragments paired at random, each with at least one gateway.
Star star_of_random_fragments(RandomSource& random) {
  const Index fragments = 1 + static_cast<Index>(random.below(3));
  std::vector<Index> slots(2 * fragments);
  for (Index slot = 0; slot < slots.size(); ++slot) {
    slots[slot] = slot;
  }
  for (Index left = slots.size() - 1; left > 0; --left) {
    std::swap(slots[left], slots[static_cast<Index>(random.below(static_cast<int>(left) + 1))]);
  }
  std::vector<bool> leaves(slots.size(), true);
  std::vector<Index> partners(slots.size());
  for (Index fragment = 0; fragment < fragments; ++fragment) {
    const Index a = slots[2 * fragment];
    const Index b = slots[2 * fragment + 1];
    partners[a] = b;
    partners[b] = a;
    leaves[a] = random.chance(0.5);
  }
  return star_of(leaves, partners);
}

/// A world in the making: gateways that lead nowhere yet.
class Growth {
 public:
  explicit Growth(const Star& first) { append(first); }

  [[nodiscard]] int place_count() const { return static_cast<int>(world_.places.size()); }
  [[nodiscard]] std::vector<WorldGateway> open_gateways() const;
  /// Those of its face to which it can be linked: in the plane, and no place twice on a path.
  [[nodiscard]] std::vector<WorldGateway> partners_of(WorldGateway open) const;
  void link(WorldGateway a, WorldGateway b) {
    leads_to(a) = b;
    leads_to(b) = a;
  }
  void add_place(WorldGateway open, const Star& star, int arrival) {
    append(star);
    link(open, {place_count() - 1, arrival});
  }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  static constexpr WorldGateway kNowhere{-1, -1};

  void append(const Star& star) {
    world_.places.push_back(
        {star, std::vector<WorldGateway>(static_cast<Index>(gateway_count(star)), kNowhere)});
  }
  WorldGateway& leads_to(WorldGateway at) {
    return world_.places[static_cast<Index>(at.place)].leads_to[static_cast<Index>(at.gateway)];
  }
  [[nodiscard]] WorldGateway across(WorldGateway at) const {
    return world_.places[static_cast<Index>(at.place)].leads_to[static_cast<Index>(at.gateway)];
  }
  [[nodiscard]] WorldGateway clockwise_of(WorldGateway at) const {
    const auto count =
        static_cast<int>(world_.places[static_cast<Index>(at.place)].leads_to.size());
    return {at.place, (at.gateway + 1) % count};
  }
  /// The places on the path that ends at an open gateway.
  [[nodiscard]] std::set<int> places_behind(WorldGateway open) const;

  World world_;
};

std::vector<WorldGateway> Growth::open_gateways() const {
  std::vector<WorldGateway> open;
  for (int place = 0; place < place_count(); ++place) {
    const auto& exits = world_.places[static_cast<Index>(place)].leads_to;
    for (int gateway = 0; gateway < static_cast<int>(exits.size()); ++gateway) {
      if (exits[static_cast<Index>(gateway)] == kNowhere) {
        open.push_back({place, gateway});
      }
    }
  }
  return open;
}

std::set<int> Growth::places_behind(WorldGateway open) const {
  std::set<int> places;
  for (WorldGateway at = open;;) {
    places.insert(at.place);
    const auto on = through_partner(world_.places[static_cast<Index>(at.place)].star, at.gateway);
    if (!on || across({at.place, *on}) == kNowhere) {
      return places;
    }
    at = across({at.place, *on});
  }
}

std::vector<WorldGateway> Growth::partners_of(WorldGateway open) const {
  const std::set<int> behind = places_behind(open);
  std::vector<WorldGateway> partners;
  for (WorldGateway at = clockwise_of(open); at != open;) {
    if (across(at) != kNowhere) {
      at = clockwise_of(across(at));
      continue;
    }
    const std::set<int> others = places_behind(at);
    const bool repeats_a_place = std::any_of(
        others.begin(), others.end(), [&behind](int place) { return behind.count(place) != 0; });
    if (!repeats_a_place) {
      partners.push_back(at);
    }
    at = clockwise_of(at);
  }
  return partners;
}

template <typename T>
const T& any_of_them(const std::vector<T>& choices, RandomSource& random) {
  return choices[static_cast<Index>(random.below(static_cast<int>(choices.size())))];
}

/// Links what can be linked, and puts dead ends behind the rest.
World finished(Growth growth, RandomSource& random) {
  for (auto open = growth.open_gateways(); !open.empty(); open = growth.open_gateways()) {
    const WorldGateway gateway = any_of_them(open, random);
    const std::vector<WorldGateway> partners = growth.partners_of(gateway);
    if (partners.empty()) {
      growth.add_place(gateway, star_of({true, false}, {1, 0}), 0);
    } else {
      growth.link(gateway, any_of_them(partners, random));
    }
  }
  return growth.world();
}

}  // namespace

Star random_star(RandomSource& random) {
  switch (random.below(9)) {
    case 0:
      return star_of({true, false}, {1, 0});  // Dead end.
    case 1:
      return star_of({true, true}, {1, 0});  // Corridor.
    case 2:
    case 3:
      return star_of({true, true, false, false}, {2, 3, 0, 1});  // L.
    case 4:
    case 5:
      return star_of({true, true, true, false}, {2, 3, 0, 1});  // T.
    case 6:
      return star_of({true, true, true, true}, {2, 3, 0, 1});  // +.
    case 7:
      return random.chance(0.5)
                 ? star_of({true, false, true, false, true, false}, {3, 4, 5, 0, 1, 2})  // Y.
                 : star_of({true, true, true, true, false, false}, {3, 4, 5, 0, 1, 2});  // K.
    default:
      return star_of_random_fragments(random);
  }
}

Status validate(const RandomWorldOptions& options) {
  return Validator("random world")
      .within("places", options.places, 1, 10'000)
      .within("star_kinds", options.star_kinds, 1, 100)
      .within("closing_probability", options.closing_probability, 0.0, 1.0)
      .status();
}

World random_world(const RandomWorldOptions& options, std::uint64_t seed) {
  RandomSource random(seed);
  // Some of the kinds must lead on, or nothing grows.
  std::vector<Star> kinds;
  while (static_cast<int>(kinds.size()) < options.star_kinds) {
    const Star star = random_star(random);
    if (!kinds.empty() || gateway_count(star) >= 3) {
      kinds.push_back(star);
    }
  }
  Growth growth(kinds.front());
  while (growth.place_count() < options.places) {
    const std::vector<WorldGateway> open = growth.open_gateways();
    const WorldGateway gateway = any_of_them(open, random);
    const std::vector<WorldGateway> partners = growth.partners_of(gateway);
    if (open.size() > 2 && !partners.empty() && random.chance(options.closing_probability)) {
      growth.link(gateway, any_of_them(partners, random));
      continue;
    }
    Star star = any_of_them(kinds, random);
    if (open.size() == 1 && gateway_count(star) < 2) {
      star = kinds.front();
    }
    growth.add_place(gateway, star, random.below(gateway_count(star)));
  }
  return finished(std::move(growth), random);
}

}  // namespace cairn::lab
