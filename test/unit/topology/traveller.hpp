#pragma once

#include <utility>
#include <vector>

#include "support/stars.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn::test {

/// A robot that tells a tree what it sees.
class Traveller {
 public:
  Traveller(const Star& star,
            int arrival_gateway,
            const TopologyOptions& options = {},
            Evidence evidence = {})
      : tree_(options, std::move(evidence)) {
    CAIRN_CHECK(tree_.start({star, arrival_gateway, VisitId{0}}).ok());
  }
  ExtendReport travel(int turn, const Star& star, int arrival_gateway) {
    return *tree_.extend({turn}, {star, arrival_gateway, VisitId{tree_.visit_count()}});
  }
  /// The reading of the star is one of two.
  ExtendReport travel(int turn, View view) {
    view.visit = VisitId{tree_.visit_count()};
    return *tree_.extend({turn}, view);
  }
  ExtendReport wake_up(const Star& star, int arrival_gateway) {
    return *tree_.wake_up({star, arrival_gateway, VisitId{tree_.visit_count()}});
  }
  [[nodiscard]] const HypothesisTree& tree() const { return tree_; }
  [[nodiscard]] HypothesisTree& tree() { return tree_; }
  [[nodiscard]] Hypothesis best() const { return tree_.best(); }
  [[nodiscard]] TopologicalMap best_map() const { return tree_.map(tree_.best().id); }
  /// Best first.
  [[nodiscard]] std::vector<TopologicalMap> maps() const {
    std::vector<TopologicalMap> maps;
    tree_.for_each_map([&](const Hypothesis&, const TopologicalMap& map) { maps.push_back(map); });
    return maps;
  }

 private:
  HypothesisTree tree_;
};

/// Around a block of four corners, always turning right: a square, a triangle, two corners or a
/// chain.
inline Traveller around_the_block(const TopologyOptions& options = {}, Evidence evidence = {}) {
  Traveller robot(corner(), 0, options, std::move(evidence));
  robot.travel(0, corner(), 1);
  for (int side = 1; side < 4; ++side) {
    robot.travel(1, corner(), 1);
  }
  return robot;
}

/// Two visits are to the same place if they lie a multiple of `places` apart, as on laps around a
/// block; how much so.
inline Evidence laps(int places, double log_ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway known, SeenGateway now) {
    return known.visit.value % places == now.visit.value % places ? log_ratio : -log_ratio;
  };
  return evidence;
}

/// The same whatever is asked.
inline Evidence always(double log_ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway, SeenGateway) { return log_ratio; };
  return evidence;
}

}  // namespace cairn::test
