#include "topology/tree_nodes.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_changes.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A chain of nodes, each the only child of the one before; the last one is held.
std::vector<NodeIndex> chain(TreeNodes& nodes, int length) {
  std::vector<NodeIndex> made = {nodes.add_root({})};
  while (static_cast<int>(made.size()) < length) {
    made.push_back(nodes.add(made.back(), {}));
  }
  nodes.hold(made.back());
  return made;
}

TEST(TreeNodes, AreForgottenWithTheLastThatNeedsThem) {
  TreeNodes nodes;
  const std::vector<NodeIndex> trunk = chain(nodes, 3);
  const NodeIndex twig = nodes.add(trunk[1], {});
  nodes.hold(twig);
  EXPECT_EQ(nodes.count(), 4U);
  nodes.release(trunk[2]);
  EXPECT_EQ(nodes.count(), 3U);
  nodes.release(twig);
  EXPECT_EQ(nodes.count(), 0U);
}

TEST(TreeNodes, StayAsLongAsAnyHypothesisStandsOnThem) {
  TreeNodes nodes;
  const std::vector<NodeIndex> trunk = chain(nodes, 2);
  nodes.hold(trunk[1]);
  nodes.release(trunk[1]);
  EXPECT_EQ(nodes.count(), 2U);
  EXPECT_EQ(nodes[trunk[1]].references, 1U);
}

TEST(TreeNodes, NeverGiveAnIdTwiceThoughTheyReusePlaces) {
  TreeNodes nodes;
  const std::vector<NodeIndex> trunk = chain(nodes, 1);
  std::set<HypothesisId> ids = {nodes[trunk[0]].id};
  std::set<NodeIndex> places;
  for (int i = 0; i < 100; ++i) {
    const NodeIndex leaf = nodes.add(trunk[0], {});
    nodes.hold(leaf);
    EXPECT_TRUE(ids.insert(nodes[leaf].id).second);
    places.insert(leaf);
    nodes.release(leaf);
  }
  EXPECT_EQ(places.size(), 1U);
  EXPECT_EQ(nodes.next_id(), 101);
}

TEST(TreeNodes, KnowTheBranchAndWhereTwoMeet) {
  TreeNodes nodes;
  const std::vector<NodeIndex> trunk = chain(nodes, 4);
  const NodeIndex twig = nodes.add(trunk[1], {});
  nodes.hold(twig);
  EXPECT_THAT(nodes.branch(trunk[3], trunk[1]), ElementsAre(trunk[2], trunk[3]));
  EXPECT_THAT(nodes.branch(twig), ElementsAre(trunk[0], trunk[1], twig));
  EXPECT_THAT(nodes.branch(twig, twig), IsEmpty());
  EXPECT_EQ(nodes.common_ancestor(trunk[3], twig), trunk[1]);
  EXPECT_EQ(nodes.common_ancestor(trunk[3], trunk[1]), trunk[1]);
  EXPECT_EQ(nodes[twig].depth, 2);
}

/// A tree that grows by changes of every kind and loses leaves, all drawn.
struct DrawnTree {
  DrawnTree(WorkingMap::Rings chosen, unsigned seed)
      : random(seed), rings(chosen), changes(stars), cursor(nodes, stars, chosen, true) {
    TreeNode root;
    root.change = {MapChange::Kind::kNothing, changes.any_star(random), VisitId{0}, -1, -1};
    root.visit = VisitId{0};
    root.position = 0;
    leaves = {nodes.add_root(root)};
    nodes.hold(leaves[0]);
    cursor.start(leaves[0]);
  }
  NodeIndex any() {
    return leaves[static_cast<std::size_t>(random_below(static_cast<int>(leaves.size()), random))];
  }
  void grow() {
    // Mostly one of the youngest, so that branches become long.
    const std::size_t back = 1 + random() % std::min<std::size_t>(leaves.size(), 4);
    const NodeIndex parent = random() % 8 == 0 ? any() : leaves[leaves.size() - back];
    leaves.push_back(nodes.add(parent, drawn(cursor.at(parent), VisitId{++visits})));
    nodes.hold(leaves.back());
  }
  /// A change, and a visit to any gateway of the map that comes of it.
  TreeNode drawn(WorkingMap& map, VisitId visit) {
    TreeNode node;
    node.visit = visit;
    node.change = changes.draw(map, visit, random);
    map.apply(node.change);
    const PlaceId place{random_below(map.place_count(), random)};
    node.position = map.gateway({place, random_below(map.gateway_count(place), random)});
    map.undo(node.change);
    return node;
  }
  void prune() {
    if (leaves.size() > 20) {
      std::swap(leaves[leaves.size() / 2], leaves.back());
      nodes.release(leaves.back());
      leaves.pop_back();
    }
  }
  WorkingMap from_scratch(NodeIndex node) const {
    WorkingMap map(stars, rings);
    for (const NodeIndex at : nodes.branch(node)) {
      if (nodes[at].parent == kNoNode) {
        map.start(nodes[at].change.star, nodes[at].change.visit);
      } else {
        map.apply(nodes[at].change);
      }
      map.record_visit(nodes[at].position, nodes[at].visit);
    }
    return map;
  }

  std::mt19937 random;
  WorkingMap::Rings rings;
  StarCatalogue stars;
  RandomChanges changes;
  TreeNodes nodes;
  MapCursor cursor;
  std::vector<NodeIndex> leaves;
  int visits = 0;
};

TEST(MapCursor, BetweenAnyTwoNodesComesToTheMapThatTheyHaveFromScratch) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const auto rings : {WorkingMap::Rings::kFaces, WorkingMap::Rings::kOne}) {
      SCOPED_TRACE(seed);
      DrawnTree tree(rings, seed);
      for (int step = 0; step < 200; ++step) {
        tree.grow();
        tree.prune();
        const NodeIndex wanted = tree.any();
        ASSERT_EQ(everything_about(tree.cursor.at(wanted)),
                  everything_about(tree.from_scratch(wanted)));
      }
    }
  }
}

TEST(MapCursor, StandsOnNodesThatWereForgottenMeanwhile) {
  DrawnTree tree(WorkingMap::Rings::kFaces, 7);
  const NodeIndex root = tree.leaves[0];
  tree.nodes.hold(root);  // For itself, as it is a leaf too.
  for (int lap = 0; lap < 50; ++lap) {
    const NodeIndex parent = tree.nodes.add(root, tree.drawn(tree.cursor.at(root), VisitId{1}));
    tree.nodes.hold(parent);
    tree.cursor.at(parent);
    tree.nodes.release(parent);  // Its place goes to the next one, the cursor still there.
  }
  EXPECT_EQ(everything_about(tree.cursor.at(root)), everything_about(tree.from_scratch(root)));
}

}  // namespace
}  // namespace cairn::test
