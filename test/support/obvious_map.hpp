#pragma once

#include <set>
#include <string>
#include <vector>

#include "exact_search/exploration.hpp"
#include "star/star.hpp"

/// Maps for the obvious tree: see obvious_tree.hpp.
namespace cairn::test {

struct ObviousGateway {
  int place = -1;
  int gateway = -1;
  friend auto operator<=>(const ObviousGateway&, const ObviousGateway&) = default;
};

struct ObviousPlace {
  Star star;
  std::vector<ObviousGateway> leads_to;  ///< By gateway; place -1 where pending.
};

struct ObviousMap {
  std::vector<ObviousPlace> places;
  ObviousGateway robot;  ///< Its place, and the gateway it came in by.
  int node = 0;          ///< Position in the history of its tree.
};

[[nodiscard]] const ObviousPlace& place_of(const ObviousMap& map, int place);
/// The gateway at the other end; place -1 where pending.
[[nodiscard]] ObviousGateway across(const ObviousMap& map, ObviousGateway at);
[[nodiscard]] bool is_pending(const ObviousMap& map, ObviousGateway at);
[[nodiscard]] ObviousGateway clockwise_of(const ObviousMap& map, ObviousGateway at);
[[nodiscard]] std::vector<ObviousGateway> all_gateways(const ObviousMap& map);
/// The gateway by which the robot leaves.
[[nodiscard]] ObviousGateway departure_of(const ObviousMap& map, int turn);

/// One place with the robot in it.
[[nodiscard]] ObviousMap first_map(const Exploration& exploration);
/// A place that leads nowhere yet.
void add_place(ObviousMap* map, const Star& star);
/// The robot travels from a to b.
void link(ObviousMap* map, ObviousGateway a, ObviousGateway b);

/// The places of every path.
[[nodiscard]] std::vector<std::set<int>> places_of_paths(const ObviousMap& map);
/// Whether the path through this gateway comes to a place twice.
[[nodiscard]] bool repeats_a_place(const ObviousMap& map, ObviousGateway on_it);
[[nodiscard]] bool is_region_consistent(const ObviousMap& map);
/// No gateway is pending.
[[nodiscard]] bool is_closed(const ObviousMap& map);
/// No two paths share two places, and no three meet pairwise but not at one place.
[[nodiscard]] bool is_perpendicular(const ObviousMap& map);
[[nodiscard]] bool has_triangle(const ObviousMap& map);
[[nodiscard]] std::set<int> common(const std::set<int>& a, const std::set<int>& b);

/// The one map in which the visits (the start first) were at these places, and came in by these
/// gateways, numbered as in the star that was seen at the first visit of the place. Places are
/// numbered 0, 1, ... as they are met.
[[nodiscard]] ObviousMap obvious_map(const Exploration& exploration,
                                     const std::vector<ObviousGateway>& visits);

/// Rooted canonical code of a map and the robot's position: places numbered breadth-first from the
/// robot's, gateways clockwise from the one by which the place was met. Each place is its star's
/// type name, the number of the view class (the lowest gateway that looks the same, counted
/// clockwise from the one at which the type name begins), and where its gateways lead.
[[nodiscard]] std::string obvious_code(const ObviousMap& map);

[[nodiscard]] bool is_region_consistent(const ObviousMap& map);
/// No gateway is pending.
[[nodiscard]] bool is_closed(const ObviousMap& map);
/// No two paths share two places, and no three meet pairwise but not at one place.
[[nodiscard]] bool is_perpendicular(const ObviousMap& map);
[[nodiscard]] bool has_triangle(const ObviousMap& map);

}  // namespace cairn::test
