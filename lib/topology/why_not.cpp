// What would have become of a map that was not kept.

#include <algorithm>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"

namespace cairn {
namespace {

/// A map that is carried on by the likeliest step at each visit.
class WhatIf {
 public:
  WhatIf(const TopologyOptions& options,
         const Evidence& evidence,
         const ExperienceLog& experience,
         StarCatalogue& stars,
         Lineage lineage)
      : lineage_(std::move(lineage)),
        position_(lineage_.position()),
        successors_(options, evidence, experience, stars, lineage_.map()) {}

  void take(const Alternative& step) {
    lineage_.map().apply(step.amendment);
    lineage_.map().apply(step.change);
    position_ = step.position;
    log_likelihood_ += step.log_likelihood;
  }
  /// False: nothing explains the visit.
  bool explain(VisitId visit) {
    std::vector<Alternative> possible;
    successors_.list({position_, visit, {}}, Successors::Detail::kPossible, possible);
    const auto best = std::max_element(possible.begin(), possible.end(),
                                       [](const Alternative& a, const Alternative& b) {
                                         return a.log_likelihood < b.log_likelihood;
                                       });
    if (best == possible.end()) {
      return false;
    }
    take(*best);
    return true;
  }
  /// What speaks against the step that came nearest to explaining the visit.
  Refutation obstacle(VisitId visit) {
    std::vector<Alternative> all;
    successors_.list({position_, visit, {}}, Successors::Detail::kAll, all);
    return all.empty() ? Refutation::kOtherView : all.front().refuted_by;
  }
  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }

 private:
  Lineage lineage_;
  GatewayIndex position_;
  Successors successors_;
  double log_likelihood_ = 0.0;
};

}  // namespace

HypothesisTree::Fate HypothesisTree::why_not(HypothesisId live,
                                             VisitId visit,
                                             std::size_t alternative) const {
  CAIRN_CHECK(visit.value > 0 && visit.value < visit_count());
  Engine& engine = *engine_;
  const Leaf& leaf = leaf_of(live);
  const Leaf earlier = before(leaf, visit);
  const std::vector<Alternative> all = alternatives_at(earlier);
  Fate fate;
  fate.visit = visit;
  if (alternative >= all.size() || has_taken(leaf, visit, all[alternative])) {
    fate.sentence = "this is what the hypothesis took the visit for";
    return fate;
  }
  const Considered asked = considered(all[alternative], visit);
  const auto refute = [&](VisitId at, Refutation reason) {
    fate.is_refuted = true;
    fate.visit = at;
    fate.reason = reason;
    fate.log_odds = -std::numeric_limits<double>::infinity();
    fate.sentence = asked.sentence;
    if (at != visit) {
      fate.sentence += "; refuted later, at visit " + std::to_string(at.value) + ": " +
                       std::string(reason_of(reason));
    }
    return fate;
  };
  if (asked.refuted_by != Refutation::kNone) {
    return refute(visit, asked.refuted_by);
  }
  Lineage lineage = lineage_of(leaf);
  double log_taken = leaf.log_steps;
  while (lineage.visit().value + 1 < visit.value) {
    lineage.advance();
  }
  WhatIf other(engine.options, engine.evidence, engine.experience, engine.stars,
               std::move(lineage));
  other.take(all[alternative]);
  for (VisitId next{visit.value + 1}; next.value < visit_count(); ++next.value) {
    if (!other.explain(next)) {
      return refute(next, other.obstacle(next));
    }
  }
  log_taken -= log_steps_before(leaf, visit);
  fate.visit = last_visit();
  fate.log_odds = other.log_likelihood() - log_taken;
  fate.sentence = asked.sentence + "; it explains everything since, with log-odds " +
                  std::to_string(fate.log_odds) + " against the live hypothesis";
  return fate;
}

/// What the steps of a hypothesis up to a visit, that visit not included, sum up to.
double HypothesisTree::log_steps_before(const Leaf& leaf, VisitId visit) const {
  Engine& engine = *engine_;
  Lineage lineage = lineage_of(leaf);
  Successors successors(engine.options, engine.evidence, engine.experience, engine.stars,
                        lineage.map());
  double since = 0.0;
  std::vector<Alternative> possible;
  const TreeNodes& nodes = engine.nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit >= visit && !nodes[node].is_part) {
      since += static_cast<double>(nodes[node].log_likelihood);
    }
  }
  // Known links leave no node: ask for them again.
  while (lineage.visit().value + 1 < visit_count()) {
    const VisitId next{lineage.visit().value + 1};
    if (next >= visit && !leaves_node(leaf, next)) {
      successors.list({lineage.position(), next, {}}, Successors::Detail::kPossible, possible);
      for (const Alternative& step : possible) {
        since += step.kind == StepKind::kKnownLink ? step.log_likelihood : 0.0;
      }
    }
    lineage.advance();
  }
  return leaf.log_steps - since;
}

bool HypothesisTree::leaves_node(const Leaf& leaf, VisitId visit) const {
  const TreeNodes& nodes = engine_->nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit == visit) {
      return true;
    }
  }
  return false;
}

}  // namespace cairn
