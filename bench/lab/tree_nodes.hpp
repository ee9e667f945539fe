#pragma once

#include <vector>

#include "bench/lab/tree_dot.hpp"
#include "exact_search/exact_search.hpp"

namespace cairn::lab {

/// The tree of maps of an exploration, node by node, parents before their children. Labels say what
/// the travel led to: "new 3" (place), "known 1", "0.2-3.1" (a loop closed between two gateways).
/// Looks at planarity, the region axiom and the bound on places only. Slow: for small trees.
[[nodiscard]] std::vector<TreeNode> nodes_of_tree(const Exploration& exploration,
                                                  const ExactSearchOptions& options);

}  // namespace cairn::lab
