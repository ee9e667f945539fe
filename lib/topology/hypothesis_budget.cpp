// Which hypotheses are live, which wait, and which are given up.

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {

Rank HypothesisTree::rank_of(const Leaf& leaf) const {
  return {leaf.log_posterior(), leaf.contradictions, leaf.path_count, leaf.place_count,
          engine_->nodes[leaf.node].id.value};
}

/// Compared with the baseline of its own time: what comes later is as likely for all, until it is
/// known better.
Rank HypothesisTree::waiting_rank_of(const Leaf& leaf) const {
  Rank rank = rank_of(leaf);
  rank.log_posterior -= baseline_log_posterior_[leaf.visit.index()];
  return rank;
}

/// Puts the best candidates into the places of their parents; the others wait.
void HypothesisTree::keep_best(ExtendReport& report) {
  const auto most = static_cast<std::size_t>(engine_->options.max_hypotheses);
  std::vector<bool> waits(candidates_.size(), false);
  if (candidates_.size() > most) {
    std::vector<std::size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank_at = [&](std::size_t index) {
      Rank rank = rank_of(candidates_[index].leaf);
      rank.age = static_cast<std::int64_t>(index);
      return rank;
    };
    const auto first_out = order.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(order.begin(), first_out, order.end(), [&](std::size_t a, std::size_t b) {
      return comes_before(rank_at(a), rank_at(b), engine_->options.preference);
    });
    std::for_each(first_out, order.end(), [&](std::size_t index) { waits[index] = true; });
  }
  std::vector<Leaf> grown;
  grown.reserve(std::min(candidates_.size(), most));
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t index = 0; index < candidates_.size(); ++index) {
    if (!waits[index]) {
      grown.push_back(grow(candidates_[index]));
      best = std::max(best, grown.back().log_posterior());
    }
  }
  baseline_log_posterior_.push_back(
      std::max(best, baseline_log_posterior_.back() + engine_->options.log_prior_new_place));
  for (std::size_t index = 0; index < candidates_.size(); ++index) {
    if (waits[index]) {
      defer(candidates_[index], report);
    }
  }
  for (const Leaf& leaf : live_) {
    engine_->nodes.release(leaf.node);
  }
  for (const NodeIndex node : std::exchange(searched_, {})) {
    engine_->nodes.release(node);
  }
  live_ = std::move(grown);
}

/// The leaf on its own node, which it holds.
Leaf HypothesisTree::grow(const Candidate& candidate) {
  TreeNodes& nodes = engine_->nodes;
  Leaf leaf = candidate.leaf;
  const bool leaves_node = candidate.kind != StepKind::kKnownLink || candidate.is_departure_open ||
                           assertions_.names(candidate.leaf.visit);
  if (leaves_node) {
    TreeNode node;
    node.kind = candidate.kind;
    node.misreading = candidate.misreading;
    node.visit = candidate.leaf.visit;
    node.position = candidate.leaf.position;
    node.log_likelihood = static_cast<float>(candidate.log_likelihood);
    if (candidate.amendment >= 0) {
      node.is_part = true;
      node.change = amendments_[static_cast<std::size_t>(candidate.amendment)];
      leaf.node = nodes.add(leaf.node, node);
      node.is_part = false;
    }
    node.change = candidate.change;
    leaf.node = nodes.add(leaf.node, node);
  }
  nodes.hold(leaf.node);
  return leaf;
}

// A leaf that was not looked at for want of time.
void HypothesisTree::defer(const Leaf& leaf, ExtendReport& report) {
  engine_->nodes.hold(leaf.node);
  waiting_.add(leaf, waiting_rank_of(leaf));
  ++report.deferred;
}

// New places wait in their parent: most of them are never needed.
void HypothesisTree::defer(const Candidate& candidate, ExtendReport& report) {
  Rank rank = waiting_rank_of(candidate.leaf);
  const bool is_only_one = candidate.amendment < 0 && !candidate.is_departure_open &&
                           engine_->experience.view(candidate.leaf.visit).others.empty() &&
                           !assertions_.names(candidate.leaf.visit);
  if (candidate.kind == StepKind::kNewPlace && is_only_one) {
    Leaf parent = candidate.leaf;
    parent.visit.value -= 1;
    parent.position = candidate.parent_position;
    parent.log_steps -= candidate.log_likelihood;
    parent.place_count -= 1;
    parent.path_count -= candidate.paths_added;
    parent.is_new_place_only = true;
    engine_->nodes.hold(parent.node);
    waiting_.add(parent, rank);
  } else {
    const Leaf leaf = grow(candidate);
    rank.age = engine_->nodes[leaf.node].id.value;
    waiting_.add(leaf, rank);
  }
  ++report.deferred;
}

/// Takes up again those that wait and have come to be better than a live one.
void HypothesisTree::revive(const Deadline& is_time_up, ExtendReport& report) {
  const TopologyOptions& options = engine_->options;
  const auto most = static_cast<std::size_t>(options.max_hypotheses);
  const auto is_better = [&](const Leaf& a, const Leaf& b) {
    return comes_before(waiting_rank_of(a), waiting_rank_of(b), options.preference);
  };
  for (int step = 0; step < options.max_revivals && !waiting_.empty(); ++step) {
    auto worst = std::max_element(live_.begin(), live_.end(), is_better);
    if (live_.size() >= most &&
        !comes_before(waiting_.best_rank(), waiting_rank_of(*worst), options.preference)) {
      break;
    }
    if (is_time_up && is_time_up()) {
      break;
    }
    const Leaf next = waiting_.take_best();
    if (next.visit == report.visit) {
      if (live_.size() >= most) {
        waiting_.add(*worst, waiting_rank_of(*worst));
        *worst = next;
      } else {
        live_.push_back(next);
      }
    } else {
      ++report.revived;
      candidates_.clear();
      bring_forward(next, report);
    }
  }
}

/// Explains one more visit; what comes of it waits.
void HypothesisTree::bring_forward(const Leaf& leaf, ExtendReport& report) {
  ExtendReport counted;  // Figure 4 counts what each arrival adds to the live ones.
  const std::size_t before = candidates_.size();
  expand(leaf, counted);
  report.breaks += counted.breaks;
  for (std::size_t index = before; index < candidates_.size(); ++index) {
    const Leaf grown = grow(candidates_[index]);
    waiting_.add(grown, waiting_rank_of(grown));
  }
  candidates_.resize(before);
  engine_->nodes.release(leaf.node);
}

void HypothesisTree::make_room(ExtendReport& report) {
  const auto is_full = [&] {
    const Memory held = memory();
    return held.bytes_of_leaves + held.bytes_of_nodes >
           static_cast<std::size_t>(engine_->options.max_bytes);
  };
  while (is_full() && !waiting_.empty()) {
    give_up(waiting_.take_worst_half(), report);
  }
  while (is_full() && live_.size() > 1) {
    give_up(take_worst_half_of_live(), report);
  }
}

/// The others keep their order.
std::vector<Leaf> HypothesisTree::take_worst_half_of_live() {
  const std::size_t kept = (live_.size() + 1) / 2;
  const Rank last_kept = rank_of(ranked()[kept - 1]);
  const auto first_out = std::stable_partition(live_.begin(), live_.end(), [&](const Leaf& leaf) {
    return !comes_before(last_kept, rank_of(leaf), engine_->options.preference);
  });
  std::vector<Leaf> worst(first_out, live_.end());
  live_.erase(first_out, live_.end());
  return worst;
}

void HypothesisTree::give_up(std::vector<Leaf> leaves, ExtendReport& report) {
  double bound = -std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : leaves) {
    bound = std::max(bound, leaf.log_posterior());
    log_given_up_ = std::max(log_given_up_, leaf.log_posterior() - log_bound_[leaf.visit.index()]);
    engine_->nodes.release(leaf.node);
  }
  report.dropped += static_cast<std::int64_t>(leaves.size());
  if (!report.guarantee_given_up && !leaves.empty()) {
    report.guarantee_given_up = GuaranteeGivenUp{
        report.visit, GuaranteeLoss::kBudget, bound,
        std::to_string(leaves.size()) + " hypotheses, at most e^" + std::to_string(bound) +
            " likely, were given up: max_bytes is " + std::to_string(engine_->options.max_bytes)};
  }
}

}  // namespace cairn
