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

void HypothesisTree::give_up(std::vector<Leaf> leaves, ExtendReport& report) {
  double bound = -std::numeric_limits<double>::infinity();
  std::int64_t dropped = 0;
  for (const Leaf& leaf : leaves) {
    bound = std::max(bound, leaf.log_posterior());
    log_given_up_ = std::max(log_given_up_, most_likely(leaf));
    dropped += leaf.count();
    engine_->nodes.release(leaf.node);
  }
  report.dropped += dropped;
  if (!report.guarantee_given_up && !leaves.empty()) {
    report.guarantee_given_up = GuaranteeGivenUp{
        report.visit, GuaranteeLoss::kBudget, bound,
        std::to_string(dropped) + " hypotheses, at most e^" + std::to_string(bound) +
            " likely, were given up: max_bytes is " + std::to_string(engine_->options.max_bytes)};
  }
}

}  // namespace cairn
