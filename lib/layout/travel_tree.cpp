#include "layout/travel_tree.hpp"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Travels by the places they touch: those of place p are [first[p], first[p + 1]).
struct TravelsByPlace {
  std::vector<int> first;
  std::vector<int> travels;
};

TravelsByPlace travels_by_place(int place_count, const std::vector<TravelConstraint>& travels) {
  TravelsByPlace by_place{std::vector<int>(at(place_count) + 1, 0),
                          std::vector<int>(2 * travels.size())};
  for (const TravelConstraint& travel : travels) {
    ++by_place.first[at(travel.from) + 1];
    ++by_place.first[at(travel.to) + 1];
  }
  for (std::size_t place = 0; place < at(place_count); ++place) {
    by_place.first[place + 1] += by_place.first[place];
  }
  std::vector<int> next(by_place.first.begin(), by_place.first.end() - 1);
  for (std::size_t i = 0; i < travels.size(); ++i) {
    by_place.travels[at(next[at(travels[i].from)]++)] = static_cast<int>(i);
    by_place.travels[at(next[at(travels[i].to)]++)] = static_cast<int>(i);
  }
  return by_place;
}

}  // namespace

TravelTree least_uncertain_ways(int place_count,
                                const std::vector<TravelConstraint>& travels,
                                const std::vector<int>& roots) {
  const TravelsByPlace by_place = travels_by_place(place_count, travels);
  TravelTree tree{{}, std::vector<int>(at(place_count), -1), std::vector<int>(at(place_count), -1)};
  std::vector<double> least(at(place_count), std::numeric_limits<double>::infinity());
  std::vector<bool> is_done(at(place_count), false);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const int root : roots) {
    least[at(root)] = 0.0;
    open.emplace(0.0, root);
  }
  while (!open.empty()) {
    const auto [uncertainty, place] = open.top();
    open.pop();
    if (is_done[at(place)]) {
      continue;
    }
    is_done[at(place)] = true;
    tree.order.push_back(place);
    for (int i = by_place.first[at(place)]; i < by_place.first[at(place) + 1]; ++i) {
      const int travel = by_place.travels[at(i)];
      const TravelConstraint& way = travels[at(travel)];
      const int neighbor = way.from == place ? way.to : way.from;
      const double candidate = uncertainty + way.T_from_to.covariance.trace();
      if (!is_done[at(neighbor)] && candidate < least[at(neighbor)]) {
        least[at(neighbor)] = candidate;
        tree.parent[at(neighbor)] = place;
        tree.travel[at(neighbor)] = travel;
        open.emplace(candidate, neighbor);
      }
    }
  }
  return tree;
}

GaussianPose displacement_from_parent(const TravelTree& tree,
                                      const std::vector<TravelConstraint>& travels,
                                      int place) {
  const TravelConstraint& travel = travels[at(tree.travel[at(place)])];
  return travel.to == place ? travel.T_from_to : inverted(travel.T_from_to);
}

}  // namespace cairn
