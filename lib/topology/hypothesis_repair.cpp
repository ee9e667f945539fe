// What to do when nothing explains an arrival, and how a map of the past is rebuilt.

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"

namespace cairn {
namespace {

/// Which of two is older does not matter.
bool is_worse(Rank a, Rank b, Preference preference) {
  a.age = b.age = 0;
  return comes_before(b, a, preference);
}

}  // namespace

/// No live hypothesis explains the arrival. Those that wait are asked first; then, if stars are not
/// expected to be misread, the whole past is searched once more with misreadings allowed, maps as
/// likely as the best of their time first; failing that, the arrival stays unexplained.
void HypothesisTree::repair(ExtendReport& report) {
  report.repair.emplace();
  search_among(waiting_, false, report);
  const bool is_among_waiting = !candidates_.empty();  // Consistent all the time: nothing is lost.
  if (candidates_.empty() && !engine_->options.noisy_stars) {
    engine_->successors.set_noisy(true);
    DeferredLeaves past(engine_->options.preference);
    const Leaf first = first_leaf();
    root_ = first.node;  // What all agreed on may be in doubt again.
    engine_->nodes.hold(first.node);
    past.add(first, baseline_rank(rank_of(first), first.visit));
    search_among(past, true, report);
    engine_->successors.set_noisy(false);
    for (const Leaf& leaf : past.take_all()) {
      log_given_up_ = std::max(log_given_up_, most_likely(leaf));
      engine_->nodes.release(leaf.node);
    }
  }
  report.repair->is_explained = !candidates_.empty();
  if (candidates_.empty()) {
    go_on_unexplained(report);
  }
  if (is_among_waiting) {
    report.repair->blamed = blamed_by(best_candidate());
  } else {
    publish_blame(report);
  }
}

const HypothesisTree::Candidate& HypothesisTree::best_candidate() const {
  return *std::min_element(
      candidates_.begin(), candidates_.end(), [&](const Candidate& a, const Candidate& b) {
        return comes_before(rank_of(a.leaf), rank_of(b.leaf), engine_->options.preference);
      });
}

/// Nothing consistent explains the arrival: says what the best map blames.
void HypothesisTree::publish_blame(ExtendReport& report) {
  const Candidate& best = best_candidate();
  report.repair->blamed = blamed_by(best);
  if (!report.guarantee_given_up) {
    report.guarantee_given_up = GuaranteeGivenUp{
        report.visit,
        report.repair->is_cut_short ? GuaranteeLoss::kSearch : GuaranteeLoss::kContradiction,
        best.leaf.log_posterior(),
        std::string(report.repair->is_cut_short
                        ? "no hypothesis tried in max_repair_steps explained the arrival; blamed: "
                        : "no hypothesis explained the arrival; blamed: ") +
            to_text(report.repair->blamed)};
  }
}

/// The map of the first visit.
Leaf HypothesisTree::first_leaf() const {
  const TreeNodes& nodes = engine_->nodes;
  const NodeIndex root = nodes.branch(root_).front();
  Leaf leaf;
  leaf.node = root;
  leaf.position = nodes[root].position;
  leaf.visit = VisitId{0};
  leaf.path_count = engine_->stars.fragment_count(nodes[root].change.star);
  leaf.place_count = 1;
  return leaf;
}

/// Best first, until some explain the arrival and, if all are wanted, none that is left can do
/// better.
void HypothesisTree::search_among(DeferredLeaves& leaves, bool all_wanted, ExtendReport& report) {
  const Preference preference = engine_->options.preference;
  const std::int64_t most = report.repair->steps + engine_->options.max_repair_steps;
  std::vector<Candidate> found;
  std::vector<Siblings> found_siblings;
  std::optional<Rank> best;
  while (!leaves.empty() && report.repair->steps < most &&
         (!best || (all_wanted && !is_worse(leaves.best_rank(), *best, preference)))) {
    const Leaf leaf = leaves.take_best();
    ++report.repair->steps;
    candidates_.clear();
    siblings_.clear();
    ExtendReport uncounted;
    const bool is_last_step = leaf.visit.value + 1 == report.visit.value;
    expand(leaf, is_last_step ? report : uncounted);
    if (is_last_step) {
      searched_.push_back(leaf.node);  // Its candidates stand on it.
      for (const Candidate& candidate : candidates_) {
        const Rank rank = baseline_rank(rank_of(candidate.leaf), VisitId{report.visit.value - 1});
        best = best && comes_before(*best, rank, preference) ? *best : rank;
      }
      found_siblings.push_back({leaf, found.size(), found.size() + candidates_.size()});
      found.insert(found.end(), candidates_.begin(), candidates_.end());
      continue;
    }
    for (const Candidate& child : candidates_) {
      const Leaf grown = grow(child);
      leaves.add(grown,
                 all_wanted ? baseline_rank(rank_of(grown), grown.visit) : waiting_rank_of(grown));
    }
    engine_->nodes.release(leaf.node);
  }
  report.repair->is_cut_short =
      report.repair->is_cut_short || (report.repair->steps >= most && !leaves.empty());
  candidates_ = std::move(found);
  siblings_ = std::move(found_siblings);
}

/// The best hypotheses only.
void HypothesisTree::go_on_unexplained(ExtendReport& report) {
  Engine& engine = *engine_;
  std::vector<Leaf> best = live_;
  const auto most =
      std::min(best.size(), static_cast<std::size_t>(engine.options.max_broken_hypotheses));
  std::partial_sort(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(most), best.end(),
                    [&](const Leaf& a, const Leaf& b) {
                      return comes_before(rank_of(a), rank_of(b), engine.options.preference);
                    });
  for (std::size_t index = 0; index < most; ++index) {
    engine.cursor.at(best[index].node);
    const Alternative broken = engine.successors.unexplained(situation_of(best[index]));
    ++report.steps[static_cast<std::size_t>(broken.kind)];
    ++report.breaks;
    siblings_.push_back({best[index], candidates_.size(), candidates_.size() + 1});
    candidates_.push_back(candidate_of(best[index], broken));
  }
  for (std::size_t index = most; index < best.size(); ++index) {
    log_given_up_ = std::max(log_given_up_, most_likely(best[index]));
  }
  report.dropped += static_cast<std::int64_t>(best.size() - most);
}

std::vector<Blame> HypothesisTree::blamed_by(const Candidate& candidate) const {
  std::vector<Blame> blamed;
  if (is_contradiction(candidate.kind)) {
    blamed.push_back(
        {candidate.leaf.visit, candidate.kind, candidate.misreading, candidate.log_likelihood});
  }
  const TreeNodes& nodes = engine_->nodes;
  for (NodeIndex node = candidate.leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (is_contradiction(nodes[node].kind) && !nodes[node].is_part) {
      blamed.push_back({nodes[node].visit, nodes[node].kind, nodes[node].misreading,
                        static_cast<double>(nodes[node].log_likelihood)});
    }
  }
  std::reverse(blamed.begin(), blamed.end());
  return blamed;
}

}  // namespace cairn
