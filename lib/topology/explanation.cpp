// Why a hypothesis is what it is, and why others are not.

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/check.hpp"
#include "star/isomorphism.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"

namespace cairn {
namespace {

std::string text_of(GatewayRef at) {
  return "gateway " + std::to_string(at.gateway) + " of place " + std::to_string(at.place.value);
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.4g", value));
  return text.data();
}

std::string_view name_of(Misreading misreading) {
  switch (misreading) {
    case Misreading::kNone:
      break;
    case Misreading::kFragments:
      return "path fragments misread";
    case Misreading::kMissedGateway:
      return "a gateway missed";
    case Misreading::kFalseGateway:
      return "a gateway imagined";
  }
  return "";
}

std::string sentence_of(const HypothesisTree::Considered& one,
                        VisitId visit,
                        const std::string& star) {
  std::string text = "visit " + std::to_string(visit.value) + " (" + star + ")";
  if (one.departure.place.is_valid()) {
    text += ", after leaving by " + text_of(one.departure);
  }
  text += ": " + std::string(name_of(one.kind));
  if (one.target.place.is_valid()) {
    text += " to " + text_of(one.target);
  }
  if (one.misreading != Misreading::kNone && one.refuted_by == Refutation::kNone) {
    text += ", " + std::string(name_of(one.misreading));
  }
  if (one.refuted_by != Refutation::kNone) {
    return text + ": refuted: " + std::string(reason_of(one.refuted_by));
  }
  return text + ": possible, log-likelihood " + text_of(one.log_likelihood) +
         (one.is_taken ? " [taken]" : "");
}

}  // namespace

std::vector<Alternative> HypothesisTree::alternatives_at(const Leaf& earlier) const {
  Engine& engine = *engine_;
  engine.cursor.at(earlier.node);
  const Situation situation = situation_of(earlier);
  std::vector<Alternative> all;
  engine.successors.list(situation, Successors::Detail::kAll, all);
  return all;
}

/// Whether the hypothesis took this alternative: the step it recorded, or the known link if none.
bool HypothesisTree::has_taken(const Leaf& leaf,
                               VisitId visit,
                               const Alternative& alternative) const {
  const TreeNodes& nodes = engine_->nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit == visit && !nodes[node].is_part) {
      const NodeIndex parent = nodes[node].parent;
      const bool has_part = parent != kNoNode && nodes[parent].is_part;
      const MapChange amendment = has_part ? nodes[parent].change : MapChange{};
      return alternative.refuted_by == Refutation::kNone && alternative.kind == nodes[node].kind &&
             alternative.change.kind == nodes[node].change.kind &&
             alternative.change.star == nodes[node].change.star &&
             alternative.amendment.star == amendment.star &&
             alternative.amendment.departure == amendment.departure &&
             alternative.amendment.target == amendment.target &&
             alternative.change.departure == nodes[node].change.departure &&
             alternative.position == nodes[node].position;
    }
  }
  return alternative.refuted_by == Refutation::kNone && alternative.kind == StepKind::kKnownLink;
}

HypothesisTree::Considered HypothesisTree::considered(const Alternative& alternative,
                                                      VisitId visit) const {
  const WorkingMap& map = engine_->cursor.map();
  Considered one;
  one.kind = alternative.kind;
  one.refuted_by = alternative.refuted_by;
  one.misreading = alternative.misreading;
  if (alternative.departure != kNoGateway && alternative.departure < map.end_gateway()) {
    one.departure = map.ref(alternative.departure);
  }
  one.target = alternative.target;
  one.log_likelihood = alternative.log_likelihood;
  one.sentence = sentence_of(one, visit, type_name(engine_->experience.view(visit).star));
  return one;
}

std::vector<HypothesisTree::Considered> HypothesisTree::explanation(HypothesisId live,
                                                                    VisitId visit) const {
  CAIRN_CHECK(visit.is_valid() && visit.value < visit_count());
  const Leaf& leaf = leaf_of(live);
  if (visit.value == 0) {
    Considered first;
    first.is_taken = true;
    first.sentence = "visit 0: the first place";
    return {first};
  }
  std::vector<Considered> all;
  bool is_any_taken = false;
  const Leaf earlier = before(leaf, visit);
  for (const Alternative& alternative : alternatives_at(earlier)) {
    all.push_back(considered(alternative, visit));
    if (has_taken(leaf, visit, alternative)) {
      all.back().is_taken = is_any_taken = true;
      all.back().sentence += " [taken]";
    }
  }
  if (!is_any_taken) {
    all.push_back(taken_at(leaf, visit));
  }
  return all;
}

/// What the hypothesis took a visit for, where that is not among the alternatives: it was left
/// unexplained, or is the outcome of a repair search.
HypothesisTree::Considered HypothesisTree::taken_at(const Leaf& leaf, VisitId visit) const {
  const TreeNodes& nodes = engine_->nodes;
  Considered taken;
  taken.is_taken = true;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit == visit && !nodes[node].is_part) {
      taken.kind = nodes[node].kind;
      taken.misreading = nodes[node].misreading;
      taken.log_likelihood = static_cast<double>(nodes[node].log_likelihood);
    }
  }
  taken.sentence =
      "visit " + std::to_string(visit.value) + ": " + std::string(name_of(taken.kind)) +
      ": nothing else explains it, log-likelihood " + text_of(taken.log_likelihood) + " [taken]";
  return taken;
}

HypothesisTree::Parting HypothesisTree::parting(HypothesisId a, HypothesisId b) const {
  const Leaf& leaf_a = leaf_of(a);
  const Leaf& leaf_b = leaf_of(b);
  CAIRN_CHECK(leaf_a.node != leaf_b.node);
  const TreeNodes& nodes = engine_->nodes;
  const NodeIndex common = nodes.common_ancestor(leaf_a.node, leaf_b.node);
  Parting parting;
  parting.visit = last_visit();
  for (const NodeIndex leaf : {leaf_a.node, leaf_b.node}) {
    const std::vector<NodeIndex> branch = nodes.branch(leaf, common);
    if (!branch.empty()) {
      parting.visit = std::min(parting.visit, nodes[branch.front()].visit);
    }
  }
  const auto taken_by = [&](HypothesisId id) {
    for (const Considered& one : explanation(id, parting.visit)) {
      if (one.is_taken) {
        return one;
      }
    }
    return Considered{};
  };
  parting.of_a = taken_by(a);
  parting.of_b = taken_by(b);
  parting.log_odds = leaf_a.log_posterior() - leaf_b.log_posterior();
  parting.sentence = "hypotheses " + std::to_string(a.value) + " and " + std::to_string(b.value) +
                     " part at visit " + std::to_string(parting.visit.value) + ": " +
                     parting.of_a.sentence + "; against " + parting.of_b.sentence + "; log-odds " +
                     text_of(parting.log_odds);
  return parting;
}

}  // namespace cairn
