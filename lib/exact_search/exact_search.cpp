// Depth-first enumeration of the tree of maps.

#include "exact_search/exact_search.hpp"

#include <utility>

#include "exact_search/depth_first.hpp"
#include "exact_search/map_tally.hpp"
#include "exact_search/replay.hpp"

namespace cairn {
namespace {

class Enumerator {
 public:
  Enumerator(const ObservedWalk& walk, const ExactSearchOptions& options)
      : walk_(walk),
        max_nodes_(options.max_nodes),
        state_(walk, options, {true, false}),
        search_(&state_, this),
        tally_(walk, options.max_codes) {}

  Enumeration run() {
    tally_.count_start();
    if (walk_.step_count() == 0) {
      look_closer(tally_.count_final(state_.start()), {});
    } else if (state_.allows_start()) {
      search_.search();
    }
    return {std::move(tally_).finish(state_.view_mismatches()), !is_done()};
  }

  bool enters(const Successor& leaf, int step) {
    if (max_nodes_ > 0 && tally_.tree_nodes() >= max_nodes_) {
      is_given_up_ = true;
      return false;
    }
    tally_.count(leaf, step);
    if (step + 1 < walk_.step_count()) {
      return true;
    }
    const MapTally::Wanted wanted = tally_.count_final(leaf.summary);
    if (wanted.any()) {
      std::vector<MapChange> changes = search_.changes();
      changes.push_back(leaf.change);
      look_closer(wanted, changes);
    }
    return false;
  }
  [[nodiscard]] bool still_enters(const Successor& /*leaf*/) const { return true; }
  [[nodiscard]] bool is_done() const { return is_given_up_; }

 private:
  void look_closer(MapTally::Wanted wanted, const std::vector<MapChange>& changes) {
    tally_.look_closer(wanted, replay(walk_, changes));
  }

  const ObservedWalk& walk_;
  std::int64_t max_nodes_;
  ExactSearchState state_;
  DepthFirst<Enumerator> search_;
  MapTally tally_;
  bool is_given_up_ = false;
};

}  // namespace

Enumeration enumerate(const Exploration& exploration, const ExactSearchOptions& options) {
  const ObservedWalk walk(exploration);
  return Enumerator(walk, options).run();
}

}  // namespace cairn
