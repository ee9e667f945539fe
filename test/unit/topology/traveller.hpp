#pragma once

#include <utility>

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
    tree_.start({star, arrival_gateway, VisitId{0}});
  }
  ExtendReport travel(int turn, const Star& star, int arrival_gateway) {
    return tree_.extend({turn}, {star, arrival_gateway, VisitId{tree_.visit_count()}});
  }
  [[nodiscard]] const HypothesisTree& tree() const { return tree_; }
  [[nodiscard]] const Hypothesis& best() const { return tree_.fringe().front(); }

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

}  // namespace cairn::test
