// Hypotheses that wait: how they are ranked, and when they are taken up again.

#include <algorithm>
#include <numeric>
#include <optional>

#include "topology/hypothesis_tree.hpp"

namespace cairn {

/// What is left of a hypothesis that waits, its steps since being unknown.
Rank HypothesisTree::waiting_rank_of(const Leaf& leaf) const {
  return waiting_rank(rank_of(leaf), leaf.visit);
}

Rank HypothesisTree::waiting_rank(Rank rank, VisitId visit) const {
  rank = baseline_rank(rank, visit);
  rank.log_posterior += visit.value * engine_->options.log_loss_waiting;
  return rank;
}

/// Compared with the baseline of its own time: what comes later is as likely for all, until it is
/// known better.
Rank HypothesisTree::baseline_rank(Rank rank, VisitId visit) const {
  rank.log_posterior -= baseline_log_posterior_[visit.index()];
  return rank;
}

// A leaf that was not looked at for want of time.
void HypothesisTree::defer(const Leaf& leaf, ExtendReport& report) {
  engine_->nodes.hold(leaf.node);
  waiting_.add(leaf, waiting_rank_of(leaf));
  ++report.deferred;
}

/// Those that wait do so in their parent: most of them are never needed.
void HypothesisTree::defer_untried(const Siblings& siblings,
                                   const std::vector<bool>& waits,
                                   ExtendReport& report) {
  Leaf parent = siblings.parent;
  parent.untried = 0;
  std::optional<Rank> best;
  for (std::size_t index = siblings.first; index < siblings.end; ++index) {
    if (!waits[index]) {
      ++parent.tried;
      continue;
    }
    const Rank rank = rank_of_candidate(index);
    const double log_likelihood = candidates_[index].log_likelihood;
    parent.log_untried =
        parent.untried == 0 ? log_likelihood : std::max(parent.log_untried, log_likelihood);
    ++parent.untried;
    best = best && comes_before(*best, rank, engine_->options.preference) ? best : rank;
  }
  if (best) {
    best->age = engine_->nodes[parent.node].id.value;
    engine_->nodes.hold(parent.node);
    waiting_.add(parent, waiting_rank(*best, VisitId{parent.visit.value + 1}));
    report.deferred += parent.untried;
  }
}

/// Positions in the candidates.
std::vector<std::size_t> HypothesisTree::best_first(const Siblings& siblings) const {
  std::vector<std::size_t> order(siblings.end - siblings.first);
  std::iota(order.begin(), order.end(), siblings.first);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return comes_before(rank_of_candidate(a), rank_of_candidate(b), engine_->options.preference);
  });
  return order;
}

/// Leaves out the last siblings that were grown before: the best ones.
void HypothesisTree::skip_tried(const Siblings& siblings) {
  std::vector<std::size_t> order = best_first(siblings);
  const auto tried = std::min(order.size(), static_cast<std::size_t>(siblings.parent.tried));
  order.erase(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(tried));
  std::sort(order.begin(), order.end());
  std::vector<Candidate> left;
  for (const std::size_t index : order) {
    left.push_back(candidates_[index]);
  }
  candidates_.resize(siblings.first);
  candidates_.insert(candidates_.end(), left.begin(), left.end());
}

/// Whether a hypothesis that waits belongs among the live ones.
bool HypothesisTree::is_wanted(const Rank& waiting) const {
  const TopologyOptions& options = engine_->options;
  Rank best = waiting_rank_of(live_.front());
  Rank worst = best;
  for (const Leaf& leaf : live_) {
    const Rank rank = waiting_rank_of(leaf);
    best = comes_before(rank, best, options.preference) ? rank : best;
    worst = comes_before(worst, rank, options.preference) ? rank : worst;
  }
  if (live_.size() >= static_cast<std::size_t>(options.max_hypotheses)) {
    return comes_before(waiting, best, options.preference);
  }
  return options.preference != Preference::kPosterior ||
         waiting.log_posterior >= best.log_posterior - options.live_margin;
}

/// Takes up again those that wait and have come to be good enough.
void HypothesisTree::revive(const Deadline& is_time_up, ExtendReport& report) {
  const TopologyOptions& options = engine_->options;
  const auto most = static_cast<std::size_t>(options.max_hypotheses);
  for (int step = 0; step < options.max_revivals && !waiting_.empty(); ++step) {
    if (!is_wanted(waiting_.best_rank()) || (is_time_up && is_time_up())) {
      break;
    }
    const Leaf next = waiting_.take_best();
    if (next.visit < report.visit) {
      ++report.revived;
      bring_forward(next, report);
      continue;
    }
    if (live_.size() >= most) {
      const auto worst =
          std::max_element(live_.begin(), live_.end(), [&](const Leaf& a, const Leaf& b) {
            return comes_before(rank_of(a), rank_of(b), options.preference);
          });
      waiting_.add(*worst, waiting_rank_of(*worst));
      live_.erase(worst);
    }
    live_.push_back(next);
  }
}

/// Explains one more visit. The best successor waits by itself, and others that belong among the
/// live ones as well.
void HypothesisTree::bring_forward(const Leaf& leaf, ExtendReport& report) {
  ExtendReport counted;  // Figure 4 counts what each arrival adds to the live ones.
  candidates_.clear();
  siblings_.clear();
  expand(leaf, counted);
  report.breaks += counted.breaks;
  std::vector<bool> waits(candidates_.size(), false);
  bool is_first = true;
  for (const std::size_t index : best_first(siblings_.front())) {
    const VisitId visit = candidates_[index].leaf.visit;
    waits[index] = !is_first && !is_wanted(waiting_rank(rank_of_candidate(index), visit));
    if (!waits[index]) {
      const Leaf grown = grow(candidates_[index]);
      waiting_.add(grown, waiting_rank_of(grown));
    }
    is_first = false;
  }
  ExtendReport uncounted;
  defer_untried(siblings_.front(), waits, uncounted);
  engine_->nodes.release(leaf.node);
}

}  // namespace cairn
