#include "bench/lab/tree_dot.hpp"

#include <set>
#include <sstream>

#include "base/check.hpp"
#include "bench/lab/map_files.hpp"

namespace cairn::lab {
namespace {

/// Nodes from which a leaf descends.
std::set<std::int64_t> alive(const std::vector<TreeNode>& nodes) {
  std::set<std::int64_t> found;
  // Children come after their parents in any tree that grew; a second look is never needed.
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    if (node->is_leaf || found.count(node->id) != 0) {
      found.insert(node->id);
      found.insert(node->parent);
    }
  }
  return found;
}

}  // namespace

std::string tree_dot(const std::vector<TreeNode>& nodes, const std::string& title) {
  CAIRN_CHECK(static_cast<std::int64_t>(nodes.size()) <= kMostDrawnNodes);
  const std::set<std::int64_t> living = alive(nodes);
  std::ostringstream dot;
  dot << "digraph tree {\n"
      << "  label=" << dot_quoted(title) << ";\n  labelloc=t;\n"
      << "  node [shape=box, style=rounded, fontsize=10, fontname=\"sans-serif\"];\n"
      << "  edge [arrowsize=0.5];\n";
  for (const TreeNode& node : nodes) {
    dot << "  n" << node.id << " [label=" << dot_quoted(node.label);
    if (node.is_leaf) {
      dot << ", style=\"rounded,filled\", fillcolor=\"#cfe8cf\"";
    } else if (living.count(node.id) == 0) {
      dot << ", color=\"#aaaaaa\", fontcolor=\"#888888\"";
    }
    dot << "];\n";
    if (node.parent >= 0) {
      dot << "  n" << node.parent << " -> n" << node.id << ";\n";
    }
  }
  dot << "}\n";
  return dot.str();
}

}  // namespace cairn::lab
