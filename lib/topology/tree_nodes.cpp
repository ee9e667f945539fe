#include "topology/tree_nodes.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace cairn {

NodeIndex TreeNodes::add(NodeIndex parent, TreeNode node) {
  node.parent = parent;
  node.serial = next_serial_++;
  node.id = node.is_same_map ? of(parent).id : HypothesisId{next_id_++};
  node.references = 0;
  node.depth = 0;
  if (parent != kNoNode) {
    node.depth = of(parent).depth + 1;
    ++of(parent).references;
  }
  NodeIndex index = first_free_;
  if (index == kNoNode) {
    if (used_ == blocks_.size() * kBlock) {
      CAIRN_CHECK(used_ < kNoNode - kBlock);
      blocks_.push_back(std::make_unique<TreeNode[]>(kBlock));
    }
    index = used_++;
  } else {
    first_free_ = of(index).parent;
  }
  of(index) = node;
  ++count_;
  return index;
}

void TreeNodes::release(NodeIndex node) {
  while (node != kNoNode && --of(node).references == 0) {
    const NodeIndex parent = of(node).parent;
    of(node).parent = first_free_;
    first_free_ = node;
    --count_;
    node = parent;
  }
}

std::vector<NodeIndex> TreeNodes::branch(NodeIndex node, NodeIndex ancestor) const {
  std::vector<NodeIndex> branch;
  for (; node != ancestor && node != kNoNode; node = (*this)[node].parent) {
    branch.push_back(node);
  }
  std::reverse(branch.begin(), branch.end());
  return branch;
}

NodeIndex TreeNodes::common_ancestor(NodeIndex a, NodeIndex b) const {
  while (a != b) {
    NodeIndex& deeper = (*this)[a].depth >= (*this)[b].depth ? a : b;
    deeper = (*this)[deeper].parent;
  }
  return a;
}

void MapCursor::start(NodeIndex root) {
  CAIRN_CHECK(applied_.empty());
  const TreeNode& node = (*nodes_)[root];
  map_.start(node.change.star, node.change.visit);
  if (records_visits_) {
    map_.record_visit(node.position, node.visit);
  }
  applied_.push_back({node.serial, node.change, {}});
}

void MapCursor::carry_out(const TreeNode& node) {
  map_.apply(node.change);
  PlaceId visited;
  if (records_visits_ && !node.is_part) {
    visited = map_.place_of(node.position);
    map_.record_visit(node.position, node.visit);
  }
  applied_.push_back({node.serial, node.change, visited});
}

void MapCursor::take_back(const Applied& last) {
  if (last.visited.is_valid()) {
    map_.forget_last_visit(last.visited);
  }
  map_.undo(last.change);
}

WorkingMap& MapCursor::at(NodeIndex node) {
  downward_.clear();
  std::size_t depth = 0;
  for (NodeIndex wanted = node;; wanted = (*nodes_)[wanted].parent) {
    depth = static_cast<std::size_t>((*nodes_)[wanted].depth);
    if (depth < applied_.size() && applied_[depth].serial == (*nodes_)[wanted].serial) {
      break;
    }
    downward_.push_back(wanted);
  }
  for (; applied_.size() > depth + 1; applied_.pop_back()) {
    take_back(applied_.back());
  }
  for (auto next = downward_.rbegin(); next != downward_.rend(); ++next) {
    carry_out((*nodes_)[*next]);
  }
  return map_;
}

}  // namespace cairn
