#include "support/obvious_tree.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "star/isomorphism.hpp"

namespace cairn::test {
namespace {

using Index = std::size_t;

std::vector<ObviousGateway> pending_on_face(const ObviousMap& map, ObviousGateway pending) {
  std::vector<ObviousGateway> found;
  for (ObviousGateway at = clockwise_of(map, pending); at != pending;) {
    if (is_pending(map, at)) {
      found.push_back(at);
    } else {
      at = across(map, at);
    }
    at = clockwise_of(map, at);
  }
  return found;
}

std::vector<ObviousGateway> candidates(const ObviousMap& map, ObviousGateway from, bool planar) {
  if (planar) {
    return pending_on_face(map, from);
  }
  std::vector<ObviousGateway> pending;
  for (const ObviousGateway at : all_gateways(map)) {
    if (is_pending(map, at) && at != from) {
      pending.push_back(at);
    }
  }
  return pending;
}

bool looks_like(const ObviousMap& map, ObviousGateway at, const ExplorationStep& step) {
  return are_alike(place_of(map, at.place).star, at.gateway, step.star, step.arrival_gateway);
}

std::string text_of(ObviousGateway at) {
  return std::to_string(at.place) + "." + std::to_string(at.gateway);
}

void grow(const ObviousMap& leaf,
          const ExplorationStep& step,
          const ObviousTreeOptions& options,
          ObviousTree* tree) {
  const auto keep = [&](const ObviousMap& map, bool is_new_map, const std::string& what) {
    tree->nodes += 1;
    tree->maps += is_new_map ? 1 : 0;
    tree->leaves.push_back(map);
    tree->leaves.back().node = static_cast<int>(tree->history.size());
    tree->history.push_back({leaf.node, what, false});
  };
  ObviousMap next = leaf;
  const ObviousGateway from = departure_of(leaf, step.turn);
  if (!is_pending(leaf, from)) {
    next.robot = across(leaf, from);
    if (looks_like(next, next.robot, step)) {
      keep(next, false, "known " + std::to_string(next.robot.place));
    } else {
      ++tree->view_mismatches;
    }
    return;
  }
  for (const ObviousGateway to : candidates(leaf, from, options.planar)) {
    next = leaf;
    link(&next, from, to);
    if (looks_like(leaf, to, step) && !repeats_a_place(next, from) &&
        (!options.region_consistent || is_region_consistent(next))) {
      keep(next, true, text_of(from) + "-" + text_of(to));
    }
  }
  next = leaf;
  add_place(&next, step.star);
  link(&next, from, {static_cast<int>(next.places.size()) - 1, step.arrival_gateway});
  if (!options.max_places || static_cast<int>(next.places.size()) <= *options.max_places) {
    keep(next, true, "new " + std::to_string(next.robot.place));
  }
}

/// One map and what decides whether it is simple.
struct Simple {
  int paths = 0;
  int places = 0;
  bool has_triangle = false;
  std::string code;
  int paths_with_two_places = 0;
  std::int64_t order_atoms = 0;
};

/// Those of the fewest paths, and of these of the fewest places.
std::vector<Simple> simplest_of(const std::vector<Simple>& maps) {
  const auto size = [](const Simple& map) { return std::pair(map.paths, map.places); };
  std::vector<Simple> simplest;
  for (const Simple& map : maps) {
    if (!simplest.empty() && size(map) < size(simplest.front())) {
      simplest.clear();
    }
    if (simplest.empty() || size(map) == size(simplest.front())) {
      simplest.push_back(map);
    }
  }
  std::sort(simplest.begin(), simplest.end(),
            [](const Simple& a, const Simple& b) { return a.code < b.code; });
  return simplest;
}

std::optional<SimplestMaps> optimal_of(const std::vector<Simple>& closed) {
  const std::vector<Simple> simplest = simplest_of(closed);
  if (simplest.empty()) {
    return {};
  }
  SimplestMaps optimal;
  optimal.count = static_cast<std::int64_t>(simplest.size());
  optimal.paths = simplest.front().paths;
  optimal.places = simplest.front().places;
  for (const Simple& map : simplest) {
    optimal.codes.push_back(map.code);
  }
  return optimal;
}

std::optional<MinimalRegionMaps> minimal_region_of(const std::vector<Simple>& maps) {
  const std::vector<Simple> simplest = simplest_of(maps);
  if (simplest.empty()) {
    return {};
  }
  MinimalRegionMaps minimal;
  minimal.count = static_cast<std::int64_t>(simplest.size());
  minimal.paths = simplest.front().paths;
  minimal.places = simplest.front().places;
  const auto fewest = [&simplest](auto field) {
    return std::min_element(
        simplest.begin(), simplest.end(),
        [field](const Simple& a, const Simple& b) { return a.*field < b.*field; });
  };
  minimal.paths_with_two_places = fewest(&Simple::paths_with_two_places)->paths_with_two_places;
  minimal.order_atoms = fewest(&Simple::order_atoms)->order_atoms;
  for (const Simple& map : simplest) {
    minimal.count_fewest_order_atoms += map.order_atoms == minimal.order_atoms ? 1 : 0;
    if (!map.has_triangle) {
      minimal.codes.push_back(map.code);
    }
  }
  minimal.count_without_triangles = static_cast<std::int64_t>(minimal.codes.size());
  return minimal;
}

}  // namespace

ObviousTree obvious_tree(const Exploration& exploration, const ObviousTreeOptions& options) {
  ObviousTree tree;
  tree.leaves.push_back(first_map(exploration));
  tree.history.push_back({-1, "start", false});
  for (const ExplorationStep& step : exploration.steps) {
    const std::vector<ObviousMap> leaves = std::exchange(tree.leaves, {});
    for (const ObviousMap& leaf : leaves) {
      grow(leaf, step, options, &tree);
    }
    tree.leaves_per_step.push_back(static_cast<std::int64_t>(tree.leaves.size()));
    tree.region_leaves_per_step.push_back(
        std::count_if(tree.leaves.begin(), tree.leaves.end(), is_region_consistent));
  }
  for (const ObviousMap& leaf : tree.leaves) {
    tree.history[static_cast<Index>(leaf.node)].is_final = true;
  }
  return tree;
}

MapCounts counts_of(const ObviousTree& tree) {
  MapCounts counts;
  counts.tree_nodes = tree.nodes;
  counts.maps_built = tree.maps;
  counts.view_mismatches = tree.view_mismatches;
  counts.leaves_per_step = tree.leaves_per_step;
  counts.region_leaves_per_step = tree.region_leaves_per_step;
  std::vector<Simple> consistent;
  std::vector<Simple> closed;
  for (const ObviousMap& map : tree.leaves) {
    const std::vector<std::set<int>> paths = places_of_paths(map);
    const bool is_closed_paper = std::all_of(paths.begin(), paths.end(),
                                             [](const auto& places) { return places.size() > 1; });
    ++counts.final_maps;
    counts.closed_paper += is_closed_paper ? 1 : 0;
    counts.closed_no_pending += is_closed(map) ? 1 : 0;
    counts.perpendicular_closed_paper += is_closed_paper && is_perpendicular(map) ? 1 : 0;
    if (is_region_consistent(map)) {
      ++counts.region_consistent_finals;
      consistent.push_back({static_cast<int>(paths.size()), static_cast<int>(map.places.size()),
                            has_triangle(map), obvious_code(map), 0, 0});
      for (const std::set<int>& places : paths) {
        const auto size = static_cast<std::int64_t>(places.size());
        consistent.back().paths_with_two_places += size > 1 ? 1 : 0;
        consistent.back().order_atoms += size * (size - 1) / 2;
      }
      if (is_closed(map)) {
        closed.push_back(consistent.back());
      }
    }
  }
  counts.optimal = optimal_of(closed);
  counts.minimal_region = minimal_region_of(consistent);
  return counts;
}

}  // namespace cairn::test
