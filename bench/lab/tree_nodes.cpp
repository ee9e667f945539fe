#include "bench/lab/tree_nodes.hpp"

#include "support/obvious_tree.hpp"

namespace cairn::lab {

std::vector<TreeNode> nodes_of_tree(const Exploration& exploration,
                                    const ExactSearchOptions& options) {
  const test::ObviousTree tree = test::obvious_tree(
      exploration, {options.planar, options.region_consistent, options.max_places});
  std::vector<TreeNode> nodes;
  for (const test::ObviousNode& node : tree.history) {
    nodes.push_back(
        {static_cast<std::int64_t>(nodes.size()), node.parent, node.what, node.is_final});
  }
  return nodes;
}

}  // namespace cairn::lab
