#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"
#include "topology/regions.hpp"

namespace cairn {

Hypothesis HypothesisTree::hypothesis_of(const Leaf& leaf) const {
  const TreeNode& node = engine_->nodes[leaf.node];
  Hypothesis hypothesis;
  hypothesis.id = node.id;
  hypothesis.parent = parent_of(node);
  hypothesis.log_steps = leaf.log_steps;
  hypothesis.log_layout = leaf.log_layout;
  hypothesis.path_count = leaf.path_count;
  hypothesis.place_count = leaf.place_count;
  hypothesis.contradictions = leaf.contradictions;
  hypothesis.is_layout_deferred = leaf.is_layout_deferred;
  return hypothesis;
}

std::vector<Leaf> HypothesisTree::ranked() const {
  std::vector<Leaf> ranked = live_;
  std::sort(ranked.begin(), ranked.end(), [&](const Leaf& a, const Leaf& b) {
    return comes_before(rank_of(a), rank_of(b), engine_->options.preference);
  });
  return ranked;
}

std::vector<Hypothesis> HypothesisTree::fringe() const {
  std::vector<Hypothesis> fringe;
  fringe.reserve(live_.size());
  for (const Leaf& leaf : ranked()) {
    fringe.push_back(hypothesis_of(leaf));
  }
  return fringe;
}

Hypothesis HypothesisTree::best() const {
  CAIRN_CHECK(is_started());
  return hypothesis_of(
      *std::min_element(live_.begin(), live_.end(), [&](const Leaf& a, const Leaf& b) {
        return comes_before(rank_of(a), rank_of(b), engine_->options.preference);
      }));
}

std::vector<double> HypothesisTree::probabilities() const {
  const std::vector<Leaf> leaves = ranked();
  double most = -std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : leaves) {
    most = std::max(most, leaf.log_posterior());
  }
  std::vector<double> shares;
  double sum = 0.0;
  for (const Leaf& leaf : leaves) {
    // Where even the best is impossible, all are equally so.
    shares.push_back(std::isinf(most) ? 1.0 : std::exp(leaf.log_posterior() - most));
    sum += shares.back();
  }
  for (double& share : shares) {
    share /= sum;
  }
  return shares;
}

double HypothesisTree::proven_gap() const {
  double best = -std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : live_) {
    best = std::max(best, leaf.log_posterior());
  }
  double rival = log_given_up_;
  waiting_.for_each([&](const Leaf& leaf) { rival = std::max(rival, most_likely(leaf)); });
  if (std::isinf(best) && best < 0.0) {
    return best;  // Nothing is proven where even the best is impossible.
  }
  return best - (rival + log_bound_.back());
}

std::vector<HypothesisId> HypothesisTree::simplest_closed() const {
  std::vector<HypothesisId> simplest;
  std::tuple<int, int> least;
  for (const Leaf& leaf : ranked()) {
    const std::tuple simplicity(leaf.path_count, leaf.place_count);
    if ((!simplest.empty() && simplicity > least) ||
        engine_->cursor.at(leaf.node).pending_count() > 0 ||
        !is_region_consistent(map_of(leaf, visit_count()))) {
      continue;
    }
    if (simplest.empty() || simplicity < least) {
      simplest.clear();
      least = simplicity;
    }
    simplest.push_back(engine_->nodes[leaf.node].id);
  }
  return simplest;
}

std::optional<HypothesisTree::PlaceClaim> HypothesisTree::claimed_place() const {
  const std::vector<double> shares = probabilities();
  const std::vector<Leaf> leaves = ranked();
  std::map<VisitId, double> share_of;
  for (std::size_t index = 0; index < leaves.size(); ++index) {
    const WorkingMap& map = engine_->cursor.at(leaves[index].node);
    share_of[map.first_visit(map.place_of(leaves[index].position))] += shares[index];
  }
  const auto best =
      std::max_element(share_of.begin(), share_of.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  double others = 0.0;
  for (const auto& [place, share] : share_of) {
    others += place == best->first ? 0.0 : share;
  }
  const double log_odds =
      others > 0.0 ? std::log(best->second / others) : std::numeric_limits<double>::infinity();
  if (log_odds < std::log(engine_->options.claim_odds)) {
    return std::nullopt;
  }
  return PlaceClaim{best->first, log_odds};
}

const Leaf& HypothesisTree::leaf_of(HypothesisId id) const {
  const auto found = std::find_if(live_.begin(), live_.end(), [&](const Leaf& leaf) {
    return engine_->nodes[leaf.node].id == id;
  });
  CAIRN_CHECK(found != live_.end());
  return *found;
}

TopologicalMap HypothesisTree::map(HypothesisId live) const {
  return map_of(leaf_of(live), visit_count());
}

void HypothesisTree::for_each_map(
    const std::function<void(const Hypothesis&, const TopologicalMap&)>& visit) const {
  for (const Leaf& leaf : ranked()) {
    visit(hypothesis_of(leaf), map_of(leaf, visit_count()));
  }
}

TopologicalMap HypothesisTree::map_at(HypothesisId live, VisitId visit) const {
  CAIRN_CHECK(visit.is_valid() && visit.value < visit_count());
  return map_of(leaf_of(live), visit.value + 1);
}

Lineage HypothesisTree::lineage_of(const Leaf& leaf) const {
  return {engine_->nodes, engine_->experience, engine_->stars, engine_->cursor.map().rings(),
          leaf.node};
}

TopologicalMap HypothesisTree::map_of(const Leaf& leaf, int visits) const {
  Lineage lineage = lineage_of(leaf);
  while (lineage.visit().value + 1 < visits) {
    lineage.advance();
  }
  return assembled(lineage.map(), lineage.departures());
}

/// @param map knows its visits
/// @param departures by visit, no place where it is not told; no more visits than these
TopologicalMap HypothesisTree::assembled(const WorkingMap& map,
                                         const std::vector<GatewayRef>& departures) const {
  Engine& engine = *engine_;
  if (!engine.shared_stars || engine.shared_stars->count() != engine.stars.count()) {
    // Maps handed out keep the catalogue they have: it may be read by another thread.
    engine.shared_stars = std::make_shared<const StarCatalogue>(engine.stars);
  }
  std::vector<TopologicalMap::PlacedVisit> placed(departures.size());
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    const StarId star = map.star(place);
    for (std::int32_t at = map.latest_record(place); at >= 0; at = map.record(at).previous) {
      const auto [visit, number, previous] = map.record(at);
      const GatewayRef departure = departures[visit.index()];
      const int left_by = departure.place.is_valid() ? departure.gateway : -1;
      const View& view = engine.experience.view(visit);
      const bool is_plain =
          view.others.empty() && engine.experience.matcher(visit).is_exact(star, number);
      placed[visit.index()] = {{place, number},
                               view.arrival_gateway,
                               is_plain
                                   ? std::vector<int>{}
                                   : engine.experience.gateways_at(visit, star, number, left_by),
                               engine.experience.is_carried(visit)};
    }
  }
  return {engine.shared_stars, map, placed};
}

/// The leaf as it was before a visit that it explains.
Leaf HypothesisTree::before(const Leaf& leaf, VisitId visit) const {
  Lineage lineage = lineage_of(leaf);
  while (lineage.visit().value + 1 < visit.value) {
    lineage.advance();
  }
  Leaf earlier;
  earlier.node = lineage.node();
  earlier.position = lineage.position();
  earlier.visit = lineage.visit();
  return earlier;
}

HypothesisId HypothesisTree::parent_of(const TreeNode& node) const {
  NodeIndex parent = node.parent;
  while (parent != kNoNode &&
         (engine_->nodes[parent].is_part || engine_->nodes[parent].id == node.id)) {
    parent = engine_->nodes[parent].parent;
  }
  return parent == kNoNode ? HypothesisId{} : engine_->nodes[parent].id;
}

NodeIndex HypothesisTree::find_node(HypothesisId id) const {
  NodeIndex found = kNoNode;
  engine_->nodes.for_each([&](NodeIndex index, const TreeNode& node) {
    found = node.id == id && !node.is_part && !node.is_same_map ? index : found;
  });
  return found;
}

HypothesisId HypothesisTree::parent(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return parent_of(engine_->nodes[find_node(id)]);
}

VisitId HypothesisTree::visit(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return engine_->nodes[find_node(id)].visit;
}

StepKind HypothesisTree::step(HypothesisId id) const {
  CAIRN_CHECK(is_known(id));
  return engine_->nodes[find_node(id)].kind;
}

std::vector<HypothesisTree::NodeView> HypothesisTree::nodes() const {
  std::map<HypothesisId, NodeView> by_id;
  engine_->nodes.for_each([&](NodeIndex, const TreeNode& node) {
    if (!node.is_part && !node.is_same_map) {
      by_id[node.id] = {node.id, parent_of(node), node.visit, node.kind,
                        static_cast<double>(node.log_likelihood)};
    }
  });
  for (const Leaf& leaf : live_) {
    by_id[engine_->nodes[leaf.node].id].is_live = true;
  }
  waiting_.for_each(
      [&](const Leaf& leaf) { by_id[engine_->nodes[leaf.node].id].is_waiting = true; });
  std::vector<NodeView> views;
  for (const auto& [id, view] : by_id) {
    views.push_back(view);
  }
  return views;
}

HypothesisTree::Memory HypothesisTree::memory() const {
  Memory memory;
  memory.nodes = engine_->nodes.count();
  memory.bytes_of_nodes = engine_->nodes.bytes();
  memory.bytes_held_for_nodes = engine_->nodes.bytes_held();
  memory.bytes_of_leaves = live_.size() * sizeof(Leaf) + waiting_.bytes();
  memory.bytes_of_experience = engine_->experience.bytes();
  memory.bytes_of_map = engine_->cursor.map().bytes();
  return memory;
}

}  // namespace cairn
