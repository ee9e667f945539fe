#include "topology/hypothesis_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/check.hpp"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a preference compares; `age` decides between equals, so that the order is reproducible.
struct Rank {
  double log_posterior = 0.0;
  int contradictions = 0;
  int path_count = 0;
  int place_count = 0;
  std::int64_t age = 0;
};

bool comes_before(const Rank& a, const Rank& b, Preference preference) {
  const auto simplicity = [](const Rank& rank) {
    return std::tuple(rank.contradictions, rank.path_count, rank.place_count);
  };
  if (preference == Preference::kPosterior) {
    return std::tuple(-a.log_posterior, simplicity(a), a.age) <
           std::tuple(-b.log_posterior, simplicity(b), b.age);
  }
  return std::tuple(simplicity(a), -a.log_posterior, a.age) <
         std::tuple(simplicity(b), -b.log_posterior, b.age);
}

void give_up_guarantee(GuaranteeLoss loss, std::string reason, ExtendReport& report) {
  if (!report.guarantee_given_up) {
    report.guarantee_given_up = GuaranteeGivenUp{report.visit, loss, std::move(reason)};
  }
}

Rank rank_of(const Hypothesis& hypothesis) {
  return {hypothesis.log_posterior(), hypothesis.contradictions, hypothesis.map.path_count(),
          hypothesis.map.place_count(), hypothesis.id.value};
}

}  // namespace

HypothesisTree::HypothesisTree(const TopologyOptions& options, Evidence evidence)
    : options_(options),
      evidence_(std::move(evidence)),
      stars_(std::make_shared<const StarCatalogue>()) {
  CAIRN_CHECK(validate(options).ok());
}

void HypothesisTree::start(const View& view) {
  CAIRN_CHECK(!is_started() && validate(view).ok() && view.visit.index() == 0);
  const Arrival arrival = recognise(view);
  experience_.push_back({{}, arrival});
  const HypothesisId root{next_id_++};
  nodes_.push_back({root, {}, view.visit, {}});
  fringe_.push_back({root, {}, TopologicalMap(stars_, arrival)});
  node_count_ = 1;
  maps_built_ = 1;
  ExtendReport unreported;
  lay_out(unreported);
}

ExtendReport HypothesisTree::extend(Action action, const View& view) {
  CAIRN_CHECK(is_started() && validate(view).ok() && view.visit.index() == experience_.size());
  const Experienced now{action, recognise(view)};
  ExtendReport report;
  report.visit = view.visit;
  std::vector<Candidate> candidates = successors(now, report);
  if (candidates.empty()) {
    candidates = break_all(now, report);
  }
  report.was_break_needed = report.breaks == static_cast<std::int64_t>(candidates.size());
  if (report.was_break_needed) {
    give_up_guarantee(GuaranteeLoss::kContradiction, contradiction(now), report);
  }
  keep_best(candidates, report);
  grow(candidates, now.arrival);
  experience_.push_back(now);
  lay_out(report);
  rank();
  forget_the_dead();
  node_count_ += report.nodes_added;
  maps_built_ += report.closures + report.new_places;
  report.leaves = static_cast<std::int64_t>(fringe_.size());
  if (!given_up_) {
    given_up_ = report.guarantee_given_up;
  }
  return report;
}

Arrival HypothesisTree::recognise(const View& view) {
  std::optional<StarId> star = stars_->find(view.star);
  if (!star) {
    // Maps handed out keep the catalogue they have: it may be read by another thread.
    auto extended = std::make_shared<StarCatalogue>(*stars_);
    star = extended->add(view.star);
    stars_ = std::move(extended);
    for (Hypothesis& leaf : fringe_) {
      leaf.map.refer_to(stars_);
    }
  }
  return {*star, view.arrival_gateway, view.visit};
}

std::vector<HypothesisTree::Candidate> HypothesisTree::successors(const Experienced& now,
                                                                  ExtendReport& report) const {
  std::vector<Candidate> candidates;
  for (std::size_t leaf = 0; leaf < fringe_.size(); ++leaf) {
    const std::size_t before = candidates.size();
    for (const Alternative& alternative :
         alternatives(fringe_[leaf].map, now.action, now.arrival, options_, evidence_)) {
      if (alternative.refuted_by == Refutation::kNone) {
        count_possible(alternative.step.kind, report);
        candidates.push_back(candidate(leaf, alternative, now.arrival));
      } else {
        count_refuted(alternative, report);
      }
    }
    if (candidates.size() == before && may_go_on_contradicted(fringe_[leaf].map, now.action)) {
      candidates.push_back(broken(leaf, now, report));
    }
  }
  return candidates;
}

bool HypothesisTree::may_go_on_contradicted(const TopologicalMap& map, Action action) const {
  return options_.keep_contradicted && evidence_.same_place &&
         !map.is_pending(map.departure(action)) &&
         map.place_count() < options_.max_places.value_or(std::numeric_limits<int>::max());
}

HypothesisTree::Candidate HypothesisTree::broken(std::size_t leaf,
                                                 const Experienced& now,
                                                 ExtendReport& report) const {
  const TopologicalMap& map = fringe_[leaf].map;
  const GatewayRef departure = map.departure(now.action);
  // From a pending gateway only the bound on places can have left no way out.
  Alternative alternative{
      {map.is_pending(departure) ? StepKind::kNewPlace : StepKind::kContradiction, departure, {}}};
  alternative.log_likelihood = options_.log_prior_new_place - options_.log_penalty_break;
  count_possible(alternative.step.kind, report);
  ++report.breaks;
  return candidate(leaf, alternative, now.arrival);
}

std::vector<HypothesisTree::Candidate> HypothesisTree::break_all(const Experienced& now,
                                                                 ExtendReport& report) const {
  const auto most = static_cast<std::size_t>(options_.max_broken_hypotheses);
  std::vector<Candidate> candidates;
  for (std::size_t leaf = 0; leaf < std::min(most, fringe_.size()); ++leaf) {
    candidates.push_back(broken(leaf, now, report));
  }
  report.dropped = static_cast<std::int64_t>(fringe_.size() - candidates.size());
  return candidates;
}

/// The best hypothesis stands for all: it is the one an operator will ask about.
std::string HypothesisTree::contradiction(const Experienced& now) const {
  const TopologicalMap& best = fringe_.front().map;
  std::string text = "no hypothesis explains the visit; in the best one: ";
  for (const Alternative& alternative :
       alternatives(best, now.action, now.arrival, options_, evidence_)) {
    text += describe(best, alternative, now.arrival) + "; ";
  }
  return text.substr(0, text.size() - 2);
}

HypothesisTree::Candidate HypothesisTree::candidate(std::size_t leaf,
                                                    const Alternative& alternative,
                                                    const Arrival& arrival) const {
  const Hypothesis& parent = fringe_[leaf];
  const StepKind kind = alternative.step.kind;
  const bool is_place_added = kind == StepKind::kNewPlace || kind == StepKind::kContradiction;
  // A link joins two paths; a break adds the fragments of its place without a link.
  const bool is_link_added =
      kind == StepKind::kNewPlace || kind == StepKind::kClosure ||
      (kind == StepKind::kMisread && parent.map.is_pending(alternative.step.departure));
  Candidate next;
  next.leaf = leaf;
  next.step = alternative.step;
  next.log_steps = parent.log_steps + alternative.log_likelihood;
  next.log_posterior = next.log_steps + parent.log_layout;
  const bool is_contradiction =
      kind == StepKind::kContradiction || kind == StepKind::kMisread || kind == StepKind::kRejoin;
  next.contradictions = parent.contradictions + (is_contradiction ? 1 : 0);
  next.path_count = parent.map.path_count() - (is_link_added ? 1 : 0) +
                    (is_place_added ? stars_->fragment_count(arrival.star) : 0);
  next.place_count = parent.map.place_count() + (is_place_added ? 1 : 0);
  return next;
}

void HypothesisTree::keep_best(std::vector<Candidate>& candidates, ExtendReport& report) const {
  const auto most = static_cast<std::size_t>(options_.max_hypotheses);
  if (candidates.size() <= most) {
    return;
  }
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_better = [&](std::size_t a, std::size_t b) {
    const auto rank_at = [&](std::size_t index) {
      const Candidate& next = candidates[index];
      return Rank{next.log_posterior, next.contradictions, next.path_count, next.place_count,
                  static_cast<std::int64_t>(index)};
    };
    return comes_before(rank_at(a), rank_at(b), options_.preference);
  };
  const auto first_dropped = order.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(order.begin(), first_dropped, order.end(), is_better);
  for (auto dropped = first_dropped; dropped != order.end(); ++dropped) {
    report.best_dropped_log_posterior =
        std::max(report.best_dropped_log_posterior, candidates[*dropped].log_posterior);
  }
  report.dropped += static_cast<std::int64_t>(order.size() - most);
  give_up_guarantee(
      GuaranteeLoss::kBudget,
      std::to_string(order.size()) + " hypotheses, max_hypotheses is " + std::to_string(most),
      report);
  order.resize(most);
  std::sort(order.begin(), order.end());
  std::vector<Candidate> kept;
  kept.reserve(most);
  for (const std::size_t index : order) {
    kept.push_back(candidates[index]);
  }
  candidates = std::move(kept);
}

void HypothesisTree::grow(const std::vector<Candidate>& candidates, const Arrival& arrival) {
  std::vector<Hypothesis> grown;
  grown.reserve(candidates.size());
  for (std::size_t index = 0; index < candidates.size(); ++index) {
    const Candidate& next = candidates[index];
    Hypothesis& parent = fringe_[next.leaf];
    const bool is_last_child =
        index + 1 == candidates.size() || candidates[index + 1].leaf != next.leaf;
    Hypothesis child{
        parent.id,      parent.parent,     is_last_child ? std::move(parent.map) : parent.map,
        next.log_steps, parent.log_layout, next.contradictions};
    if (next.step.kind != StepKind::kKnownLink) {
      child.id = HypothesisId{next_id_++};
      child.parent = parent.id;
      nodes_.push_back({child.id, child.parent, arrival.visit, next.step});
    }
    apply(next.step, arrival, child.map);
    CAIRN_CHECK(child.map.path_count() == next.path_count &&
                child.map.place_count() == next.place_count);  // What it was ranked by.
    grown.push_back(std::move(child));
  }
  fringe_ = std::move(grown);
}

void HypothesisTree::lay_out(ExtendReport& report) {
  if (!evidence_.layout) {
    return;
  }
  // A layout inherited from the parent is an upper bound, so the order need not be revised.
  std::stable_sort(fringe_.begin(), fringe_.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.log_posterior() > b.log_posterior();
  });
  double best = -kInfinity;
  for (Hypothesis& leaf : fringe_) {
    leaf.is_layout_deferred = leaf.log_posterior() < best - options_.layout_margin;
    if (leaf.is_layout_deferred) {
      ++report.layouts_deferred;
      continue;
    }
    leaf.log_layout = evidence_.layout(leaf.map);
    CAIRN_CHECK(leaf.log_layout < kInfinity);  // NaN compares false.
    best = std::max(best, leaf.log_posterior());
    ++report.layouts_evaluated;
  }
}

void HypothesisTree::rank() {
  std::sort(fringe_.begin(), fringe_.end(), [&](const Hypothesis& a, const Hypothesis& b) {
    return comes_before(rank_of(a), rank_of(b), options_.preference);
  });
}

}  // namespace cairn
