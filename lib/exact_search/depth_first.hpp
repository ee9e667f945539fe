#pragma once

#include <cstddef>
#include <vector>

#include "exact_search/exact_search_state.hpp"

namespace cairn {

/// Goes through a tree of maps depth first, with one working state and no recursion: the length of
/// an experience is not bounded by the stack.
///
/// A Visitor has
///     bool enters(const Successor&, int step)  for every successor as it is generated: whether to
///                                              look at its successors later; false for the last
///     bool still_enters(const Successor&)      when its turn has come
///     bool is_done()                           asked after every node
template <typename Visitor>
class DepthFirst {
 public:
  DepthFirst(ExactSearchState* state, Visitor* visitor) : state_(state), visitor_(visitor) {}

  /// Leaves the state as it was unless the visitor is done before.
  void search() {
    frames_.assign(1, {});
    expand(state_->start());
    while (!visitor_->is_done()) {
      if (waiting_.size() > frames_.back().waiting) {
        enter_next();
      } else if (frames_.size() > 1) {
        state_->undo(frames_.back().change, depth() - 1);
        frames_.pop_back();
      } else {
        return;
      }
    }
  }

  /// From the root to the node whose successors are visited.
  [[nodiscard]] std::vector<MapChange> changes() const {
    std::vector<MapChange> changes;
    for (std::size_t index = 1; index < frames_.size(); ++index) {
      changes.push_back(frames_[index].change);
    }
    return changes;
  }

 private:
  /// A node between the root and the present one.
  struct Frame {
    MapChange change;         ///< That made it.
    std::size_t waiting = 0;  ///< Where its successors begin in waiting_.
  };

  [[nodiscard]] int depth() const { return static_cast<int>(frames_.size()) - 1; }

  void enter_next() {
    const Successor next = waiting_.back();
    waiting_.pop_back();
    if (!visitor_->still_enters(next)) {
      return;
    }
    state_->apply(next.change, depth());
    frames_.push_back({next.change, 0});
    expand(next.summary);
  }

  void expand(const MapSummary& node) {
    const std::size_t first = waiting_.size();
    frames_.back().waiting = first;
    state_->expand(node, depth(), &waiting_);
    std::size_t kept = first;
    for (std::size_t index = first; index < waiting_.size(); ++index) {
      if (visitor_->enters(waiting_[index], depth())) {
        waiting_[kept++] = waiting_[index];
      }
    }
    waiting_.resize(kept);
  }

  ExactSearchState* state_;
  Visitor* visitor_;
  std::vector<Frame> frames_;
  std::vector<Successor> waiting_;  // Of all frames, those of the last one at the end.
};

}  // namespace cairn
