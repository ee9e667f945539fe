#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "topology/reading_match.hpp"
#include "topology/step.hpp"
#include "topology/working_map.hpp"

namespace cairn {

using NodeIndex = std::uint32_t;
constexpr NodeIndex kNoNode = std::numeric_limits<NodeIndex>::max();

/// How one map grew from another, or what became of the robot in it. Where visits are not
/// remembered, travels along known links leave no node, unless they were misread.
struct TreeNode {
  MapChange change;
  StepKind kind = StepKind::kStart;
  bool is_part = false;      ///< Its child, of the same visit, completes the step.
  bool is_same_map = false;  ///< A travel along a known link: the map is its parent's, and the id.
  NodeIndex parent = kNoNode;
  std::int32_t depth = 0;        ///< Nodes above it.
  std::uint32_t references = 0;  ///< Children, and hypotheses that stand on it.
  HypothesisId id;
  std::uint32_t serial = 0;            ///< Tells apart nodes that had the same place in the list.
  VisitId visit;                       ///< At which the map grew so.
  GatewayIndex position = kNoGateway;  ///< The gateway by which the robot came in, after the step.
  float log_likelihood = 0.0F;         ///< Of the step.
  Misreading misreading = Misreading::kNone;
};
static_assert(sizeof(TreeNode) <= 64);

/// The nodes of a tree that somebody still needs: each leads to its parent; a node that has neither
/// children nor a hypothesis on it is forgotten, and its place taken by the next one.
class TreeNodes {
 public:
  /// The first node. @pre there is none
  NodeIndex add_root(const TreeNode& node) { return add(kNoNode, node); }
  /// The parent, id, serial and depth of the node are filled in. Nobody holds it yet.
  NodeIndex add(NodeIndex parent, TreeNode node);
  /// A hypothesis stands on the node from now on.
  void hold(NodeIndex node) { ++of(node).references; }
  /// A hypothesis has left; forgets the node and those above it that nobody needs any more.
  void release(NodeIndex node);

  [[nodiscard]] const TreeNode& operator[](NodeIndex node) const {
    return blocks_[node / kBlock][node % kBlock];
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Ids below it are not given any more.
  void skip_ids(std::int32_t next_id) { next_id_ = next_id; }
  /// Given so far.
  [[nodiscard]] std::int32_t next_id() const { return next_id_; }
  /// Calls visit(index, node) for each that is needed, in no order.
  template <typename Visitor>
  void for_each(Visitor visit) const {
    for (NodeIndex index = 0; index < used_; ++index) {
      if ((*this)[index].references > 0) {
        visit(index, (*this)[index]);
      }
    }
  }
  /// Of the nodes that are needed: the places of forgotten ones are used again.
  [[nodiscard]] std::size_t bytes() const { return count() * sizeof(TreeNode); }
  /// Of all blocks.
  [[nodiscard]] std::size_t bytes_held() const {
    return blocks_.size() * kBlock * sizeof(TreeNode);
  }
  /// From just below the ancestor down to the node.
  /// @param ancestor kNoNode: from the root on
  [[nodiscard]] std::vector<NodeIndex> branch(NodeIndex node, NodeIndex ancestor = kNoNode) const;
  [[nodiscard]] NodeIndex common_ancestor(NodeIndex a, NodeIndex b) const;

 private:
  static constexpr std::size_t kBlock = 1024;

  [[nodiscard]] TreeNode& of(NodeIndex node) { return blocks_[node / kBlock][node % kBlock]; }

  std::vector<std::unique_ptr<TreeNode[]>> blocks_;  // Grows without moving, by a block at a time.
  NodeIndex used_ = 0;                               // Of the blocks, free ones included.
  NodeIndex first_free_ = kNoNode;                   // Their `parent` is the next free one.
  std::size_t count_ = 0;
  std::int32_t next_id_ = 0;
  std::uint32_t next_serial_ = 0;
};

/// A working map that moves about in the tree: it takes back the changes up to the common ancestor,
/// and carries out those down to the wanted node. Nodes above which it stands may be forgotten.
class MapCursor {
 public:
  /// @param nodes, stars outlive the cursor
  /// @param records_visits the map remembers who visited its places
  MapCursor(const TreeNodes& nodes,
            const StarCatalogue& stars,
            WorkingMap::Rings rings,
            bool records_visits)
      : nodes_(&nodes), map_(stars, rings), records_visits_(records_visits) {}

  /// The map of the root. @pre not started
  void start(NodeIndex root);
  /// The map of a node. Changes that the caller makes to it must be taken back before the next
  /// call.
  /// @pre started; the node is not forgotten
  WorkingMap& at(NodeIndex node);
  [[nodiscard]] const WorkingMap& map() const { return map_; }
  [[nodiscard]] WorkingMap& map() { return map_; }

 private:
  struct Applied {
    std::uint32_t serial = 0;
    MapChange change;
    PlaceId visited;  ///< Whose record is to be forgotten again; none.
  };

  void carry_out(const TreeNode& node);
  void take_back(const Applied& last);

  const TreeNodes* nodes_;
  WorkingMap map_;
  bool records_visits_;
  std::vector<Applied> applied_;     // By depth.
  std::vector<NodeIndex> downward_;  // Reused.
};

}  // namespace cairn
