// Best-first search, and iterative deepening for long experiences.

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "exact_search/depth_first.hpp"
#include "exact_search/exact_search.hpp"
#include "exact_search/open_list.hpp"
#include "exact_search/replay.hpp"

namespace cairn {
namespace {

/// Best-first search walks through the tree from one node to the next: up to two times the length
/// of the experience for each. Iterative deepening has no such walks, but looks at nodes again, and
/// at every map within a bound on the first part of the cost. So it pays for long experiences, if
/// that part hardly grows (orders that count corners) and few maps lie within it (look_ahead).
constexpr int kLongExperience = 256;

bool suits_iterative_deepening(const ObservedWalk& walk,
                               const ExactSearchOptions& options,
                               SearchOrder order) {
  const bool counts_corners =
      order == SearchOrder::kCorners || order == SearchOrder::kPathsWithCorners;
  return walk.step_count() > kLongExperience && options.look_ahead && counts_corners;
}

constexpr std::int64_t kMostNodes = std::numeric_limits<std::int32_t>::max();

ExactSearchState::Needs needs_of(SearchOrder order) {
  return {false, order == SearchOrder::kCorners || order == SearchOrder::kPathsWithCorners};
}

void set_map(const ObservedWalk& walk, const std::vector<MapChange>& changes, BestMap* best) {
  best->map = replay(walk, changes);
  best->code = canonical_code(*best->map);
}

class BestFirst {
 public:
  BestFirst(const ObservedWalk& walk, const ExactSearchOptions& options, SearchOrder order)
      : walk_(walk),
        order_(order),
        max_nodes_(options.max_nodes > 0 ? std::min(options.max_nodes, kMostNodes) : kMostNodes),
        state_(walk, options, needs_of(order)) {}

  BestMap run() {
    BestMap best;
    best.tree_nodes = best.maps_built = 1;
    best.bytes_per_node = sizeof(Node);
    best.bytes_per_open = OpenList::kBytesPerNode;
    nodes_.push_back({-1, kStays});
    passed_.push_back({0, {}, state_.start()});
    if (state_.allows_start()) {
      open_.add({cost_of(state_.start(), order_), 0, 0});
    }
    while (!open_.is_empty() && best.is_complete) {
      const OpenList::Entry next = open_.take();
      move_to(next);
      if (next.depth == walk_.step_count()) {
        set_map(walk_, changes(), &best);
        best.is_proven = true;
        return best;
      }
      expand(next.depth, &best);
    }
    best.is_proven = best.is_complete;
    return best;
  }

 private:
  /// One step of one map. What the step did: a gateway that is linked, or one of the constants.
  struct Node {
    std::int32_t parent = -1;
    GatewayIndex target = kStays;
  };
  static constexpr GatewayIndex kStays = -1;
  static constexpr GatewayIndex kAddsPlace = -2;

  /// A node between the root and the present one.
  struct Passed {
    std::int32_t node = 0;
    MapChange change;
    MapSummary summary;
  };

  [[nodiscard]] int depth() const { return static_cast<int>(passed_.size()) - 1; }

  // Back to the common ancestor and on from there.
  void move_to(const OpenList::Entry& entry) {
    ahead_.clear();
    std::int32_t node = entry.node;
    int at = entry.depth;
    while (at > depth() || passed_[static_cast<std::size_t>(at)].node != node) {
      ahead_.push_back(node);
      node = nodes_[static_cast<std::size_t>(node)].parent;
      --at;
    }
    while (depth() > at) {
      state_.undo(passed_.back().change, depth() - 1);
      passed_.pop_back();
    }
    for (; !ahead_.empty(); ahead_.pop_back()) {
      step_to(ahead_.back());
    }
    MapSummary& summary = passed_.back().summary;
    summary.corners_needed = corners_needed_in(entry.cost, summary, order_);
  }

  void step_to(std::int32_t node) {
    const GatewayIndex target = nodes_[static_cast<std::size_t>(node)].target;
    const MapSummary& from = passed_.back().summary;
    const ObservedStep& step = walk_.step(depth());
    MapChange change;
    change.departure = state_.departure(from, depth());
    if (target == kAddsPlace) {
      change = {MapChange::Kind::kPlace, step.star, VisitId{depth() + 1}, change.departure,
                step.arrival_gateway};
    } else if (target != kStays) {
      change = {MapChange::Kind::kLink, {}, VisitId{depth() + 1}, change.departure, target};
    }
    MapSummary summary = state_.outline(from, change);
    state_.apply(change, depth());
    passed_.push_back({node, change, summary});
  }

  void expand(int depth, BestMap* best) {
    successors_.clear();
    const Passed& node = passed_.back();
    state_.expand(node.summary, depth, &successors_);
    for (const Successor& successor : successors_) {
      if (best->tree_nodes >= max_nodes_) {
        best->is_complete = false;
        return;
      }
      const MapChange::Kind kind = successor.change.kind;
      ++best->tree_nodes;
      best->maps_built += kind == MapChange::Kind::kNothing ? 0 : 1;
      if (depth + 1 == walk_.step_count() && successor.summary.pending > 0) {
        continue;
      }
      const GatewayIndex target = kind == MapChange::Kind::kLink    ? successor.change.target
                                  : kind == MapChange::Kind::kPlace ? kAddsPlace
                                                                    : kStays;
      open_.add({cost_of(successor.summary, order_), depth + 1,
                 static_cast<std::int32_t>(nodes_.size())});
      nodes_.push_back({node.node, target});
    }
    best->max_open = std::max(best->max_open, open_.size());
    best->stored_nodes = static_cast<std::int64_t>(nodes_.size());
  }

  [[nodiscard]] std::vector<MapChange> changes() const {
    std::vector<MapChange> changes;
    for (std::size_t index = 1; index < passed_.size(); ++index) {
      changes.push_back(passed_[index].change);
    }
    return changes;
  }

  const ObservedWalk& walk_;
  SearchOrder order_;
  std::int64_t max_nodes_;
  ExactSearchState state_;
  OpenList open_;
  std::vector<Node> nodes_;
  std::vector<Passed> passed_;
  std::vector<std::int32_t> ahead_;
  std::vector<Successor> successors_;
};

/// Depth-first searches that go no further than a bound on the first part of the cost, which grows
/// until a closed map is found; the second part is bounded by the best one so far.
class IterativeDeepening {
 public:
  IterativeDeepening(const ObservedWalk& walk, const ExactSearchOptions& options, SearchOrder order)
      : walk_(walk),
        order_(order),
        max_nodes_(options.max_nodes),
        state_(walk, options, needs_of(order)),
        search_(&state_, this) {}

  BestMap run() {
    best_.tree_nodes = best_.maps_built = 1;
    best_.bytes_per_node = 0;
    limit_ = cost_of(state_.start(), order_).first;
    bool may_exist = state_.allows_start();
    while (may_exist && !best_.map && !is_done()) {
      next_limit_ = kNoLimit;
      search_.search();
      may_exist = next_limit_ != kNoLimit;
      limit_ = next_limit_;
    }
    best_.is_proven = best_.is_complete;
    return best_;
  }

  bool enters(const Successor& successor, int step) {
    if (max_nodes_ > 0 && best_.tree_nodes >= max_nodes_) {
      best_.is_complete = false;
      return false;
    }
    ++best_.tree_nodes;
    best_.maps_built += successor.change.kind == MapChange::Kind::kNothing ? 0 : 1;
    const SearchCost cost = cost_of(successor.summary, order_);
    if (cost.first > limit_) {
      next_limit_ = std::min(next_limit_, cost.first);
      return false;
    }
    if (!still_enters(successor)) {
      return false;
    }
    if (step + 1 < walk_.step_count()) {
      return true;
    }
    if (successor.summary.pending == 0) {
      std::vector<MapChange> changes = search_.changes();
      changes.push_back(successor.change);
      set_map(walk_, changes, &best_);
      best_cost_ = cost;
    }
    return false;
  }
  [[nodiscard]] bool still_enters(const Successor& successor) const {
    return !best_.map || cost_of(successor.summary, order_) < best_cost_;
  }
  [[nodiscard]] bool is_done() const { return !best_.is_complete; }

 private:
  static constexpr std::int32_t kNoLimit = std::numeric_limits<std::int32_t>::max();

  const ObservedWalk& walk_;
  SearchOrder order_;
  std::int64_t max_nodes_;
  ExactSearchState state_;
  DepthFirst<IterativeDeepening> search_;
  std::int32_t limit_ = 0;
  std::int32_t next_limit_ = kNoLimit;
  SearchCost best_cost_;
  BestMap best_;
};

}  // namespace

BestMap find_best(const Exploration& exploration,
                  const ExactSearchOptions& options,
                  SearchOrder order) {
  const ObservedWalk walk(exploration);
  if (suits_iterative_deepening(walk, options, order)) {
    return IterativeDeepening(walk, options, order).run();
  }
  return BestFirst(walk, options, order).run();
}

}  // namespace cairn
