#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact_search/exploration.hpp"
#include "exact_search/map_counts.hpp"
#include "support/obvious_map.hpp"

/// The tree of maps of Savelli and Kuipers, IROS 2004, in the shortest and most obvious way: every
/// map is copied whole, faces and paths are walked anew for every question. Shares nothing with
/// lib/topology but plain data, so that the two can be held against each other.
namespace cairn::test {

struct ObviousTreeOptions {
  bool planar = false;
  bool region_consistent = false;  ///< As an axiom: a map that is not dies.
  std::optional<int> max_places;
};

/// A node of the tree; parents come before their children.
struct ObviousNode {
  int parent = -1;
  std::string what;  ///< "new 3", "known 1" (places), "0.2-3.1" (gateways of a closed loop).
  bool is_final = false;
};

struct ObviousTree {
  std::vector<ObviousMap> leaves;
  std::vector<ObviousNode> history;
  std::int64_t nodes = 1;
  std::int64_t maps = 1;
  std::int64_t view_mismatches = 0;
  std::vector<std::int64_t> leaves_per_step;
  std::vector<std::int64_t> region_leaves_per_step;
};

/// Every map that is consistent with the exploration.
/// @pre the exploration is valid
[[nodiscard]] ObviousTree obvious_tree(const Exploration& exploration,
                                       const ObviousTreeOptions& options);

/// What obvious_tree() gave, counted; all codes are kept.
[[nodiscard]] MapCounts counts_of(const ObviousTree& tree);

}  // namespace cairn::test
