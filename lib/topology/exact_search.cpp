// Depth-first enumeration of the tree of maps.

#include "topology/exact_search.hpp"

#include <utility>

#include "topology/exact_search_state.hpp"
#include "topology/map_tally.hpp"
#include "topology/replay.hpp"

namespace cairn {
namespace {

class DepthFirstSearch {
 public:
  DepthFirstSearch(const ObservedWalk& walk, const ExactSearchOptions& options)
      : walk_(walk),
        options_(options),
        state_(walk, options, {true, false}),
        tally_(walk, options.max_codes) {}

  Enumeration run() {
    tally_.count_start();
    if (walk_.step_count() == 0) {
      count_final(nullptr, state_.start());
    } else if (state_.allows_start()) {
      search();
    }
    return {std::move(tally_).finish(state_.view_mismatches()), !is_cut_off_};
  }

 private:
  /// A node whose map the state passed on its way to the present one.
  struct Frame {
    MapChange change;         ///< That made it.
    std::size_t waiting = 0;  ///< Where its successors begin in waiting_.
  };

  void search() {
    expand(state_.start());
    while (!is_cut_off_) {
      if (waiting_.size() > frames_.back().waiting) {
        const Successor next = waiting_.back();
        waiting_.pop_back();
        state_.apply(next.change, depth() - 1);
        frames_.push_back({next.change, 0});
        expand(next.summary);
      } else if (frames_.size() > 1) {
        state_.undo(frames_.back().change, depth() - 2);
        frames_.pop_back();
      } else {
        return;
      }
    }
  }

  [[nodiscard]] int depth() const { return static_cast<int>(frames_.size()); }

  /// Counts the successors of the last frame's node, and keeps those that have successors.
  void expand(const MapSummary& node) {
    if (frames_.empty()) {
      frames_.emplace_back();
    }
    const int step = depth() - 1;
    const std::size_t first = waiting_.size();
    frames_.back().waiting = first;
    state_.expand(node, step, &waiting_);
    const bool are_final = step + 1 == walk_.step_count();
    for (std::size_t index = first; index < waiting_.size(); ++index) {
      tally_.count(waiting_[index], step);
      if (are_final) {
        count_final(&waiting_[index].change, waiting_[index].summary);
      }
    }
    if (are_final) {
      waiting_.resize(first);
    }
    is_cut_off_ = options_.max_nodes > 0 && tally_.tree_nodes() >= options_.max_nodes;
  }

  void count_final(const MapChange* last, const MapSummary& map) {
    const MapTally::WantedCodes wanted = tally_.count_final(map);
    if (!wanted.optimal && !wanted.minimal_region) {
      return;
    }
    std::vector<MapChange> changes;
    for (std::size_t index = 1; index < frames_.size(); ++index) {
      changes.push_back(frames_[index].change);
    }
    if (last != nullptr) {
      changes.push_back(*last);
    }
    tally_.add_code(wanted, canonical_code(replay(walk_, changes)));
  }

  const ObservedWalk& walk_;
  const ExactSearchOptions& options_;
  ExactSearchState state_;
  MapTally tally_;
  std::vector<Frame> frames_;       // From the root to the present node.
  std::vector<Successor> waiting_;  // Of all frames, those of the last one at the end.
  bool is_cut_off_ = false;
};

}  // namespace

Enumeration enumerate(const Exploration& exploration, const ExactSearchOptions& options) {
  const ObservedWalk walk(exploration);
  return DepthFirstSearch(walk, options).run();
}

}  // namespace cairn
