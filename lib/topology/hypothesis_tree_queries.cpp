#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "base/check.hpp"
#include "star/isomorphism.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/regions.hpp"

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

/// Where a step puts the visit; no two alternatives put it at the same place by the same gateway.
VisitedPlace place_after(const Step& step, const Arrival& arrival, TopologicalMap map) {
  apply(step, arrival, map);
  return map.at_visit(arrival.visit);
}

}  // namespace

std::vector<double> HypothesisTree::probabilities() const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& leaf : fringe_) {
    most = std::max(most, leaf.log_posterior());
  }
  std::vector<double> shares;
  double sum = 0.0;
  for (const Hypothesis& leaf : fringe_) {
    // Where even the best is impossible, all are equally so.
    shares.push_back(std::isinf(most) ? 1.0 : std::exp(leaf.log_posterior() - most));
    sum += shares.back();
  }
  for (double& share : shares) {
    share /= sum;
  }
  return shares;
}

std::vector<HypothesisId> HypothesisTree::simplest_closed() const {
  std::vector<HypothesisId> simplest;
  std::tuple<int, int> least;
  for (const Hypothesis& leaf : fringe_) {
    const std::tuple simplicity(leaf.map.path_count(), leaf.map.place_count());
    if (!leaf.map.is_closed() || (!simplest.empty() && simplicity > least) ||
        !is_region_consistent(leaf.map)) {
      continue;
    }
    if (simplest.empty() || simplicity < least) {
      simplest.clear();
      least = simplicity;
    }
    simplest.push_back(leaf.id);
  }
  return simplest;
}

const TopologicalMap& HypothesisTree::map(HypothesisId leaf) const {
  return leaf_of(leaf).map;
}

const Hypothesis& HypothesisTree::leaf_of(HypothesisId id) const {
  const auto found = std::find_if(fringe_.begin(), fringe_.end(),
                                  [&](const Hypothesis& leaf) { return leaf.id == id; });
  CAIRN_CHECK(found != fringe_.end());
  return *found;
}

TopologicalMap HypothesisTree::map_at(HypothesisId leaf, VisitId visit) const {
  CAIRN_CHECK(visit.is_valid() && visit.index() < experience_.size());
  std::vector<const Node*> growth;  // By visit; nothing where a known link was followed.
  growth.resize(experience_.size(), nullptr);
  for (const Node* node = find_node(leaf_of(leaf).id); node != nullptr;
       node = find_node(node->parent)) {
    growth[node->visit.index()] = node;
  }
  TopologicalMap map(stars_, experience_.front().arrival);
  for (std::size_t next = 1; next <= visit.index(); ++next) {
    const Experienced& then = experience_[next];
    if (growth[next] != nullptr) {
      apply(growth[next]->step, then.arrival, map);
    } else {
      map.follow(map.departure(then.action), then.arrival);
    }
  }
  return map;
}

HypothesisId HypothesisTree::parent(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return find_node(id)->parent;
}

Step HypothesisTree::step(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return find_node(id)->step;
}

VisitId HypothesisTree::visit(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return find_node(id)->visit;
}

std::vector<std::string> HypothesisTree::explanation(HypothesisId leaf, VisitId visit) const {
  const VisitedPlace outcome = leaf_of(leaf).map.at_visit(visit);
  if (visit.index() == 0) {
    return {"visit 0: the first place"};
  }
  const Experienced& now = experience_[visit.index()];
  const TopologicalMap before = map_at(leaf, VisitId{visit.value - 1});
  std::vector<std::string> lines;
  bool is_among_alternatives = false;
  for (const Alternative& alternative :
       alternatives(before, now.action, now.arrival, options_, evidence_)) {
    const bool is_taken = alternative.refuted_by == Refutation::kNone &&
                          place_after(alternative.step, now.arrival, before) == outcome;
    is_among_alternatives = is_among_alternatives || is_taken;
    lines.push_back(describe(before, alternative, now.arrival) + (is_taken ? " [taken]" : ""));
  }
  if (!is_among_alternatives) {
    lines.push_back("visit " + std::to_string(visit.value) +
                    ": nothing explains it; recorded as a new place by a break [taken]");
  }
  return lines;
}

std::string HypothesisTree::describe(const TopologicalMap& map,
                                     const Alternative& alternative,
                                     const Arrival& arrival) const {
  const Step& step = alternative.step;
  std::string text = "visit " + std::to_string(arrival.visit.value) + " (" +
                     type_name(stars_->star(arrival.star)) + "), after leaving by " +
                     text_of(step.departure) + ": " + std::string(name_of(step.kind));
  if (step.target.place.is_valid()) {
    text += " to " + text_of(step.target) + " (" + type_name(map.star(step.target.place)) + ")";
  }
  if (alternative.refuted_by == Refutation::kNone) {
    return text + ": possible, log-likelihood " + text_of(alternative.log_likelihood);
  }
  return text + ": refuted: " + std::string(reason_of(alternative.refuted_by));
}

const HypothesisTree::Node* HypothesisTree::find_node(HypothesisId id) const {
  const auto found =
      std::lower_bound(nodes_.begin(), nodes_.end(), id,
                       [](const Node& node, HypothesisId wanted) { return node.id < wanted; });
  return found != nodes_.end() && found->id == id ? &*found : nullptr;
}

void HypothesisTree::forget_the_dead() {
  constexpr std::size_t kSpareNodes = 4'096;  // So that small trees are never cut.
  if (nodes_.size() <= 2 * nodes_to_keep_ + kSpareNodes) {
    return;
  }
  const auto index_of = [&](HypothesisId id) {
    return static_cast<std::size_t>(find_node(id) - nodes_.data());
  };
  std::vector<bool> is_alive(nodes_.size(), false);
  for (const Hypothesis& leaf : fringe_) {
    is_alive[index_of(leaf.id)] = true;
  }
  std::vector<Node> alive;
  for (std::size_t index = nodes_.size(); index-- > 0;) {
    if (is_alive[index]) {
      alive.push_back(nodes_[index]);
      if (nodes_[index].parent.is_valid()) {
        is_alive[index_of(nodes_[index].parent)] = true;
      }
    }
  }
  std::reverse(alive.begin(), alive.end());
  nodes_ = std::move(alive);
  nodes_to_keep_ = nodes_.size();
}

}  // namespace cairn
