// The guarantee behind Fig. 4 of Kuipers et al., ICRA 2004: the tree holds every map that is
// consistent with the experience, hence always the true one.

#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/planarity.hpp"
#include "topology/regions.hpp"

namespace cairn::test {
namespace {

Lattice random_streets(std::mt19937& random) {
  const int rows = 2 + static_cast<int>(random() % 3);
  const int columns = 2 + static_cast<int>(random() % 3);
  Lattice streets(rows, columns);
  for (int attempt = 0; attempt < 4; ++attempt) {
    const int place = static_cast<int>(random()) & 0xffff;
    const int direction = static_cast<int>(random() % 4);
    const int from = place % streets.place_count();
    if (streets.is_open(from, direction) && streets.degree(from) > 1 &&
        streets.degree(streets.neighbour(from, direction)) > 1) {
      streets.remove_street(from, direction);
    }
  }
  return streets;
}

/// Whether the map says of all visits where they truly were: the same places, the same way round.
bool is_true_map(const TopologicalMap& map, const Walk& walk) {
  std::set<std::pair<int, int>> pairs;
  std::set<int> true_places;
  for (std::size_t visit = 0; visit < walk.truth.size(); ++visit) {
    const VisitedPlace at = map.at_visit({static_cast<std::int32_t>(visit)});
    if (at.shift != 0) {
      return false;
    }
    pairs.insert({walk.truth[visit].first, at.place.value});
    true_places.insert(walk.truth[visit].first);
  }
  return pairs.size() == true_places.size() &&
         map.place_count() == static_cast<int>(true_places.size());
}

HypothesisTree explore(const Walk& walk, TopologyOptions options) {
  options.max_hypotheses = 1'000'000;
  HypothesisTree tree(options);
  EXPECT_TRUE(tree.start(walk.start).ok());
  for (const Experienced& step : walk.steps) {
    EXPECT_TRUE(tree.extend(step.action, step.view).ok());
  }
  EXPECT_EQ(tree.waiting_count(), 0);
  return tree;
}

template <typename Predicate>
std::int64_t count_maps(const HypothesisTree& tree, Predicate holds) {
  std::int64_t count = 0;
  tree.for_each_map(
      [&](const Hypothesis&, const TopologicalMap& map) { count += holds(map) ? 1 : 0; });
  return count;
}

std::int64_t count_true(const HypothesisTree& tree, const Walk& walk) {
  return count_maps(tree, [&](const TopologicalMap& map) { return is_true_map(map, walk); });
}

Walk random_walk(unsigned seed) {
  std::mt19937 random(seed);
  const Lattice streets = random_streets(random);
  const int start = static_cast<int>(random() % static_cast<unsigned>(streets.place_count()));
  return streets.walk(start, streets.random_moves(start, 20, random));
}

TEST(HypothesisTruth, TheTrueMapIsExactlyOneOfTheLeaves) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_walk(seed);
    for (const bool planar : {false, true}) {
      for (const bool region_consistent : {false, true}) {
        TopologyOptions options;
        options.planar = planar;
        options.region_consistent = region_consistent;
        const HypothesisTree tree = explore(walk, options);
        EXPECT_FALSE(tree.guarantee_given_up());
        EXPECT_EQ(count_true(tree, walk), 1);
      }
    }
  }
}

// Oracle: Euler's formula on every finished map against the test of faces at each closure.
TEST(HypothesisTruth, FacesLeaveExactlyTheMapsOfGenusZero) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_walk(seed);
    TopologyOptions spatial;
    spatial.planar = false;
    const HypothesisTree all = explore(walk, spatial);
    const HypothesisTree planar = explore(walk, {});
    const auto is_planar = [](const TopologicalMap& map) { return genus(map) == 0; };
    EXPECT_EQ(count_maps(planar, is_planar), planar.live_count());
    EXPECT_EQ(count_maps(all, is_planar), planar.live_count());
  }
}

// Oracle: a violation never heals, so testing at each closure and testing the finished maps agree.
TEST(HypothesisTruth, RegionsAsAnAxiomLeaveExactlyTheRegionConsistentMaps) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_walk(seed);
    TopologyOptions with_regions;
    with_regions.region_consistent = true;
    const HypothesisTree all = explore(walk, {});
    const HypothesisTree pruned = explore(walk, with_regions);
    EXPECT_EQ(count_maps(all, is_region_consistent), pruned.live_count());
  }
}

}  // namespace
}  // namespace cairn::test
