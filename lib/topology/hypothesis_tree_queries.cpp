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

bool is_same(const Step& a, const Step& b) {
  return a.kind == b.kind && a.target == b.target;
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
  const auto found = std::find_if(fringe_.begin(), fringe_.end(),
                                  [&](const Hypothesis& other) { return other.id == leaf; });
  CAIRN_CHECK(found != fringe_.end());
  return found->map;
}

TopologicalMap HypothesisTree::map_at(HypothesisId id) const {
  std::vector<const Node*> chain;
  for (const Node* node = find_node(id); node != nullptr; node = find_node(node->parent)) {
    chain.push_back(node);
  }
  CAIRN_CHECK(!chain.empty());
  TopologicalMap map(stars_, experience_.front().arrival);
  for (auto node = chain.rbegin() + 1; node != chain.rend(); ++node) {
    apply((*node)->step, experience_[(*node)->visit.index()].arrival, map);
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

std::vector<std::string> HypothesisTree::explanation(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  const Node& node = *find_node(id);
  if (!node.parent.is_valid()) {
    return {"visit 0: the first place"};
  }
  const Experienced& now = experience_[node.visit.index()];
  const TopologicalMap before = map_at(node.parent);
  std::vector<std::string> lines;
  bool is_among_alternatives = false;
  for (const Alternative& alternative :
       alternatives(before, now.action, now.arrival, options_, evidence_)) {
    const bool is_taken =
        alternative.refuted_by == Refutation::kNone && is_same(alternative.step, node.step);
    is_among_alternatives = is_among_alternatives || is_taken;
    lines.push_back(describe(before, alternative, now.arrival) + (is_taken ? " [taken]" : ""));
  }
  if (!is_among_alternatives) {
    lines.push_back("visit " + std::to_string(node.visit.value) +
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
  constexpr std::size_t kSpareNodes = 65'536;  // So that small trees are never cut.
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
  for (std::size_t index = nodes_.size(); index-- > 0;) {  // Children come after their parents.
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
