#pragma once

#include <cstddef>
#include <vector>

#include "topology/leaf.hpp"

namespace cairn {

/// Hypotheses that wait: consistent so far, but not among the best when they were last looked at.
class DeferredLeaves {
 public:
  explicit DeferredLeaves(Preference preference) : preference_(preference) {}

  /// @param rank the leaf's, or that of its best untried successor; its posterior compared with
  /// that of other arrivals
  void add(const Leaf& leaf, const Rank& rank);
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  /// Of maps.
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// The one to look at first. @pre !empty()
  [[nodiscard]] const Rank& best_rank() const { return waiting_.front().rank; }
  /// Takes it out. @pre !empty()
  [[nodiscard]] Leaf take_best();
  /// Takes the worse half out, in no order. @pre !empty()
  [[nodiscard]] std::vector<Leaf> take_worst_half();
  /// Everyone, in no order.
  [[nodiscard]] std::vector<Leaf> take_all();

  template <typename Visitor>
  void for_each(Visitor visit) const {
    for (const Waiting& one : waiting_) {
      visit(one.leaf);
    }
  }
  [[nodiscard]] std::size_t bytes() const { return waiting_.size() * sizeof(Waiting); }

 private:
  struct Waiting {
    Leaf leaf;
    Rank rank;
  };
  [[nodiscard]] bool is_worse(const Waiting& a, const Waiting& b) const;

  Preference preference_;
  std::vector<Waiting> waiting_;  // A heap, the best first.
  std::int64_t count_ = 0;
};

}  // namespace cairn
