#include "bench/lab/drawn_map.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/check.hpp"
#include "bench/lab/codes.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

struct SeenView {
  std::string type;
  ViewCode slots;  ///< Clockwise from the gateway of entry.
};

std::map<std::string, SeenView> views_of(const Exploration& seen) {
  std::map<std::string, SeenView> views;
  const auto add = [&views](const Star& star) {
    for (int gateway = 0; gateway < gateway_count(star); ++gateway) {
      views.emplace(view_token(star, gateway), SeenView{type_name(star), view_code(star, gateway)});
    }
  };
  add(seen.start);
  for (const ExplorationStep& step : seen.steps) {
    add(step.star);
  }
  return views;
}

/// Joins path fragments that links connect.
class Fragments {
 public:
  explicit Fragments(const std::vector<ViewCode>& stars) {
    for (const ViewCode& star : stars) {
      first_.push_back(static_cast<int>(parent_.size()));
      parent_.resize(parent_.size() + star.size());
      std::iota(parent_.begin() + first_.back(), parent_.end(), first_.back());
      for (Index slot = 0; slot < star.size(); ++slot) {
        const Index partner = (slot + static_cast<Index>(star[slot] / 2)) % star.size();
        join(first_.back() + static_cast<int>(slot), first_.back() + static_cast<int>(partner));
      }
    }
  }

  [[nodiscard]] int slot_of(int place, int slot) const {
    return first_[static_cast<Index>(place)] + slot;
  }
  [[nodiscard]] int slot_count() const { return static_cast<int>(parent_.size()); }
  [[nodiscard]] int root_of(int slot) const {
    while (parent_[static_cast<Index>(slot)] != slot) {
      slot = parent_[static_cast<Index>(slot)];
    }
    return slot;
  }
  void join(int a, int b) {
    // The lowest becomes the root, so that paths are numbered as their places are.
    const int root_a = root_of(a);
    const int root_b = root_of(b);
    parent_[static_cast<Index>(std::max(root_a, root_b))] = std::min(root_a, root_b);
  }

 private:
  std::vector<int> first_;
  std::vector<int> parent_;
};

int gateway_count(const CodedPlace& place) {
  return static_cast<int>(place.exits.size());
}

/// By visit, the place and the gateway of the code by which the robot came in. A map and where the
/// robot is tell the whole way back: the gateway of arrival and the turn before the last travel.
std::vector<CodedPlace::Exit> arrivals_of(const std::vector<CodedPlace>& coded,
                                          const Exploration& seen) {
  std::vector<CodedPlace::Exit> arrivals(seen.steps.size() + 1);
  arrivals.back() = {0, 0};
  for (Index step = seen.steps.size(); step-- > 0;) {
    const CodedPlace::Exit at = arrivals[step + 1];
    const CodedPlace::Exit from =
        coded[static_cast<Index>(at.place)].exits[static_cast<Index>(at.offset)];
    CAIRN_CHECK(from.place >= 0 && "the code is of another exploration");
    const int count = gateway_count(coded[static_cast<Index>(from.place)]);
    const int turn = seen.steps[step].turn % count;
    arrivals[step] = {from.place, (from.offset - turn + count) % count};
  }
  return arrivals;
}

/// By place, the number of the gateway from which its code counts, in the star that was seen when
/// the robot first came there.
std::vector<int> first_gateways_of(const std::vector<CodedPlace>& coded, const Exploration& seen) {
  const std::vector<CodedPlace::Exit> arrivals = arrivals_of(coded, seen);
  std::vector<int> first(coded.size(), 0);
  for (Index visit = arrivals.size(); visit-- > 0;) {
    const CodedPlace::Exit at = arrivals[visit];
    const int number = visit == 0 ? seen.start_gateway : seen.steps[visit - 1].arrival_gateway;
    const int count = gateway_count(coded[static_cast<Index>(at.place)]);
    first[static_cast<Index>(at.place)] = (number - at.offset + count) % count;
  }
  return first;
}

/// Renumbers the gateways of a code as their stars do.
std::vector<CodedPlace> numbered_as_stars(const std::vector<CodedPlace>& coded,
                                          const std::vector<int>& first) {
  std::vector<CodedPlace> numbered = coded;
  const auto number = [&](int place, int offset) {
    return (first[static_cast<Index>(place)] + offset) %
           gateway_count(coded[static_cast<Index>(place)]);
  };
  for (int place = 0; place < static_cast<int>(coded.size()); ++place) {
    const auto& exits = coded[static_cast<Index>(place)].exits;
    for (int offset = 0; offset < static_cast<int>(exits.size()); ++offset) {
      CodedPlace::Exit exit = exits[static_cast<Index>(offset)];
      exit.offset = exit.place < 0 ? 0 : number(exit.place, exit.offset);
      numbered[static_cast<Index>(place)].exits[static_cast<Index>(number(place, offset))] = exit;
    }
  }
  return numbered;
}

/// @param numbered its gateways are numbered as in the stars
/// @param first by place, the gateway from which its view counts
std::vector<DrawnPlace> places_of(const std::vector<CodedPlace>& numbered,
                                  const std::vector<int>& first,
                                  const std::map<std::string, SeenView>& views) {
  std::vector<DrawnPlace> places;
  for (Index place = 0; place < numbered.size(); ++place) {
    const CodedPlace& coded = numbered[place];
    DrawnPlace drawn;
    drawn.star = views.at(coded.view).type;
    const ViewCode& slots = views.at(coded.view).slots;
    drawn.slots = static_cast<int>(slots.size());
    for (int slot = 0; slot < drawn.slots; ++slot) {
      if (slots[static_cast<Index>(slot)] % 2 == 1) {
        drawn.slot_of_gateway.push_back(slot);
      }
    }
    std::rotate(drawn.slot_of_gateway.begin(), drawn.slot_of_gateway.end() - first[place],
                drawn.slot_of_gateway.end());
    for (const CodedPlace::Exit& exit : coded.exits) {
      drawn.is_pending.push_back(exit.place < 0);
    }
    places.push_back(std::move(drawn));
  }
  return places;
}

std::vector<DrawnLink> links_of(const std::vector<CodedPlace>& numbered) {
  std::vector<DrawnLink> links;
  for (int place = 0; place < static_cast<int>(numbered.size()); ++place) {
    const auto& exits = numbered[static_cast<Index>(place)].exits;
    for (int gateway = 0; gateway < static_cast<int>(exits.size()); ++gateway) {
      const CodedPlace::Exit& exit = exits[static_cast<Index>(gateway)];
      if (std::pair(place, gateway) < std::pair(exit.place, exit.offset)) {
        links.push_back({place, gateway, exit.place, exit.offset, 0});
      }
    }
  }
  return links;
}

void number_paths(const std::vector<ViewCode>& stars, DrawnMap* map) {
  Fragments fragments(stars);
  const auto slot_of = [&](int place, int gateway) {
    const DrawnPlace& drawn = map->places[static_cast<Index>(place)];
    return fragments.slot_of(place, drawn.slot_of_gateway[static_cast<Index>(gateway)]);
  };
  for (const DrawnLink& link : map->links) {
    fragments.join(slot_of(link.from_place, link.from_gateway),
                   slot_of(link.to_place, link.to_gateway));
  }
  std::map<int, int> number_of_root;
  for (int slot = 0; slot < fragments.slot_count(); ++slot) {
    number_of_root.emplace(fragments.root_of(slot), static_cast<int>(number_of_root.size()));
  }
  map->path_count = static_cast<int>(number_of_root.size());
  for (int place = 0; place < static_cast<int>(map->places.size()); ++place) {
    DrawnPlace& drawn = map->places[static_cast<Index>(place)];
    for (int gateway = 0; gateway < static_cast<int>(drawn.slot_of_gateway.size()); ++gateway) {
      drawn.path_of_gateway.push_back(
          number_of_root.at(fragments.root_of(slot_of(place, gateway))));
    }
  }
  for (DrawnLink& link : map->links) {
    link.path = map->places[static_cast<Index>(link.from_place)]
                    .path_of_gateway[static_cast<Index>(link.from_gateway)];
  }
}

}  // namespace

DrawnMap drawn_map(const std::string& code, const Exploration& seen, const std::string& title) {
  const std::map<std::string, SeenView> views = views_of(seen);
  const std::vector<CodedPlace> coded = parsed_code(code);
  std::vector<ViewCode> stars;
  for (const CodedPlace& place : coded) {
    const auto view = views.find(place.view);
    CAIRN_CHECK(view != views.end() && "the code is of another exploration");
    stars.push_back(view->second.slots);
  }
  DrawnMap map;
  map.title = title;
  const std::vector<int> first = first_gateways_of(coded, seen);
  const std::vector<CodedPlace> numbered = numbered_as_stars(coded, first);
  map.places = places_of(numbered, first, views);
  map.links = links_of(numbered);
  map.robot_gateway = first[0];
  number_paths(stars, &map);
  return map;
}

}  // namespace cairn::lab
