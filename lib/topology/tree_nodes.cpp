#include "topology/tree_nodes.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace cairn {

NodeIndex TreeNodes::add(NodeIndex parent, TreeNode node) {
  node.parent = parent;
  node.id = HypothesisId{next_id_++};
  node.references = 0;
  node.depth = 0;
  if (parent != kNoNode) {
    node.depth = nodes_[parent].depth + 1;
    ++nodes_[parent].references;
  }
  if (free_.empty()) {
    CAIRN_CHECK(nodes_.size() < kNoNode);
    nodes_.push_back(node);
    return static_cast<NodeIndex>(nodes_.size() - 1);
  }
  const NodeIndex index = free_.back();
  free_.pop_back();
  nodes_[index] = node;
  return index;
}

void TreeNodes::release(NodeIndex node) {
  while (node != kNoNode && --nodes_[node].references == 0) {
    free_.push_back(node);
    node = nodes_[node].parent;
  }
}

std::vector<NodeIndex> TreeNodes::branch(NodeIndex node, NodeIndex ancestor) const {
  std::vector<NodeIndex> branch;
  for (; node != ancestor && node != kNoNode; node = nodes_[node].parent) {
    branch.push_back(node);
  }
  std::reverse(branch.begin(), branch.end());
  return branch;
}

NodeIndex TreeNodes::common_ancestor(NodeIndex a, NodeIndex b) const {
  while (a != b) {
    NodeIndex& deeper = nodes_[a].depth >= nodes_[b].depth ? a : b;
    deeper = nodes_[deeper].parent;
  }
  return a;
}

void MapCursor::start(NodeIndex root) {
  CAIRN_CHECK(applied_.empty());
  const TreeNode& node = (*nodes_)[root];
  map_.start(node.change.star, node.change.visit);
  applied_.push_back({node.id, node.change});
}

WorkingMap& MapCursor::at(NodeIndex node) {
  downward_.clear();
  std::size_t depth = 0;
  for (NodeIndex wanted = node;; wanted = (*nodes_)[wanted].parent) {
    depth = static_cast<std::size_t>((*nodes_)[wanted].depth);
    if (depth < applied_.size() && applied_[depth].id == (*nodes_)[wanted].id) {
      break;
    }
    downward_.push_back(wanted);
  }
  for (; applied_.size() > depth + 1; applied_.pop_back()) {
    map_.undo(applied_.back().change);
  }
  for (auto next = downward_.rbegin(); next != downward_.rend(); ++next) {
    const TreeNode& below = (*nodes_)[*next];
    map_.apply(below.change);
    applied_.push_back({below.id, below.change});
  }
  return map_;
}

}  // namespace cairn
