#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::lab {

/// A node of a tree of maps, as it is drawn.
struct TreeNode {
  std::int64_t id = 0;
  std::int64_t parent = -1;  ///< -1: the root.
  std::string label;
  bool is_leaf = false;  ///< Consistent with the whole exploration.
};

/// More do not make a picture that anybody can read.
inline constexpr std::int64_t kMostDrawnNodes = 2000;

/// The tree for Graphviz, from the root down; leaves are filled, nodes that died are grey.
/// @pre at most kMostDrawnNodes
[[nodiscard]] std::string tree_dot(const std::vector<TreeNode>& nodes, const std::string& title);

}  // namespace cairn::lab
