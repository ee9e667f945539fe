// Which hypotheses are live, which wait, and which are given up.

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {

Rank HypothesisTree::rank_of(const Leaf& leaf) const {
  return {leaf.log_posterior(), leaf.contradictions, leaf.path_count, leaf.place_count,
          engine_->nodes[leaf.node].id.value};
}

/// The older one of equal candidates is the one that was found first.
Rank HypothesisTree::rank_of_candidate(std::size_t index) const {
  Rank rank = rank_of(candidates_[index].leaf);
  rank.age = static_cast<std::int64_t>(index);
  return rank;
}

/// By candidate: the best ones live, as long as they are not too far behind the very best.
std::vector<bool> HypothesisTree::those_that_wait() const {
  const TopologyOptions& options = engine_->options;
  const auto most = static_cast<std::size_t>(options.max_hypotheses);
  std::vector<bool> waits(candidates_.size(), false);
  if (options.preference == Preference::kPosterior) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates_) {
      best = std::max(best, candidate.leaf.log_posterior());
    }
    std::transform(candidates_.begin(), candidates_.end(), waits.begin(), [&](const Candidate& c) {
      return c.leaf.log_posterior() < best - options.live_margin;
    });
  }
  std::vector<std::size_t> order;
  for (std::size_t index = 0; index < candidates_.size(); ++index) {
    if (!waits[index]) {
      order.push_back(index);
    }
  }
  if (order.size() <= most) {
    return waits;
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return comes_before(rank_of_candidate(a), rank_of_candidate(b), options.preference);
  });
  for (const std::size_t index : order) {
    waits[index] = true;
  }
  const std::vector<NodeIndex> forks = forks_from(candidates_[order.front()].leaf.node);
  std::map<NodeIndex, int> taken_at;
  std::size_t taken = 0;
  for (const bool is_diverse : {true, false}) {
    for (const std::size_t index : order) {
      if (waits[index] && taken < most &&
          (!is_diverse || ++taken_at[forks[index]] <= options.max_alike)) {
        waits[index] = false;
        ++taken;
      }
    }
  }
  return waits;
}

/// By candidate, the node at which its map parts from that of a leaf.
std::vector<NodeIndex> HypothesisTree::forks_from(NodeIndex leaf) const {
  const TreeNodes& nodes = engine_->nodes;
  std::vector<NodeIndex> trunk = nodes.branch(leaf);  // By depth.
  std::vector<NodeIndex> forks(candidates_.size(), kNoNode);
  for (const Siblings& siblings : siblings_) {
    NodeIndex at = siblings.parent.node;
    while (static_cast<std::size_t>(nodes[at].depth) >= trunk.size() ||
           trunk[static_cast<std::size_t>(nodes[at].depth)] != at) {
      at = nodes[at].parent;
    }
    std::fill(forks.begin() + static_cast<std::ptrdiff_t>(siblings.first),
              forks.begin() + static_cast<std::ptrdiff_t>(siblings.end), at);
  }
  return forks;
}

/// By how much the best candidate explains the arrival worse than what evidence says of the
/// likeliest place of its map, less what one of so many says by chance: then the map may be wrong
/// from an earlier visit on, such that this place is out of reach.
double HypothesisTree::surprise_of_best() {
  Engine& engine = *engine_;
  if (candidates_.empty() || !engine.evidence.same_place ||
      engine.options.preference != Preference::kPosterior) {
    return 0.0;
  }
  const Candidate& best = best_candidate();
  engine.cursor.at(best.leaf.node);
  const double possible = engine.successors.likeliest_place(best.leaf.visit).in_favour;
  return std::max(0.0, possible - std::max(best.log_likelihood, 0.0));
}

/// Puts the best candidates into the places of their parents; the others wait.
void HypothesisTree::keep_best(ExtendReport& report) {
  const std::vector<bool> waits = those_that_wait();
  const double surprise = surprise_of_best();
  std::vector<Leaf> grown;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t index = 0; index < candidates_.size(); ++index) {
    if (!waits[index]) {
      grown.push_back(grow(candidates_[index]));
      best = std::max(best, grown.back().log_posterior());
    }
  }
  double best_before = -std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : live_) {
    best_before = std::max(best_before, leaf.log_posterior());
  }
  const double gained = std::isfinite(best - best_before) ? best - best_before : 0.0;
  baseline_log_posterior_.push_back(baseline_log_posterior_.back() +
                                    std::max(gained, engine_->options.log_prior_new_place) +
                                    surprise);
  if (report.repair) {  // Their parents could not find them again.
    for (std::size_t index = 0; index < candidates_.size(); ++index) {
      if (waits[index]) {
        const Leaf leaf = grow(candidates_[index]);
        waiting_.add(leaf, waiting_rank_of(leaf));
        ++report.deferred;
      }
    }
  } else {
    for (const Siblings& siblings : siblings_) {
      defer_untried(siblings, waits, report);
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
  const bool is_same_map = candidate.kind == StepKind::kKnownLink && !candidate.is_departure_open &&
                           !assertions_.names(candidate.leaf.visit);
  if (!is_same_map || engine_->records_visits) {
    TreeNode node;
    node.is_same_map = is_same_map;
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

void HypothesisTree::lay_out(ExtendReport& report) {
  const Engine& engine = *engine_;
  if (!engine.evidence.layout) {
    return;
  }
  // A layout inherited from the parent is an upper bound, so the order need not be revised.
  std::vector<std::size_t> order(live_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return live_[a].log_posterior() > live_[b].log_posterior();
  });
  const double best_before = live_[order.front()].log_posterior();
  double best = -std::numeric_limits<double>::infinity();
  for (const std::size_t index : order) {
    Leaf& leaf = live_[index];
    leaf.is_layout_deferred = leaf.log_posterior() < best - engine.options.layout_margin;
    if (leaf.is_layout_deferred) {
      ++report.layouts_deferred;
      continue;
    }
    leaf.log_layout = engine.evidence.layout(map_of(leaf, leaf.visit.value + 1));
    CAIRN_CHECK(leaf.log_layout < std::numeric_limits<double>::infinity());  // NaN compares false.
    best = std::max(best, leaf.log_posterior());
    ++report.layouts_evaluated;
  }
  // The layout makes all less likely, those that wait too once they are laid out.
  if (std::isfinite(best) && std::isfinite(best_before)) {
    baseline_log_posterior_.back() += best - best_before;
  }
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

/// As of visit 0, that is less all that may have been gained since.
double HypothesisTree::most_likely(const Leaf& waiting) const {
  return waiting.untried > 0
             ? waiting.log_posterior() + waiting.log_untried - log_bound_[waiting.visit.index() + 1]
             : waiting.log_posterior() - log_bound_[waiting.visit.index()];
}

/// The bound holds for whatever the maps given up might have come to by now.
void HypothesisTree::give_up(std::vector<Leaf> leaves, ExtendReport& report) {
  double bound = -std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : leaves) {
    bound = std::max(bound, most_likely(leaf) + log_bound_.back());
    log_given_up_ = std::max(log_given_up_, most_likely(leaf));
    report.dropped += leaf.count();
    engine_->nodes.release(leaf.node);
  }
  std::optional<GuaranteeGivenUp>& given_up = report.guarantee_given_up;
  if (leaves.empty() || (given_up && given_up->loss != GuaranteeLoss::kBudget)) {
    return;
  }
  if (given_up) {
    bound = std::max(bound, given_up->log_posterior_bound);
  }
  given_up = GuaranteeGivenUp{report.visit, GuaranteeLoss::kBudget, bound,
                              std::to_string(report.dropped) + " hypotheses, at most e^" +
                                  std::to_string(bound) + " likely, were given up: max_bytes is " +
                                  std::to_string(engine_->options.max_bytes)};
}

}  // namespace cairn
