// Fig. 4 of Savelli and Kuipers, IROS 2004: how large the tree of maps grows on grids of streets,
// with and without planarity. The walks generate themselves, so the counts need no recorded data.

#include <algorithm>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/regions.hpp"

namespace cairn::test {
namespace {

struct Counts {
  std::int64_t tree_nodes = 0;
  std::int64_t maps_built = 0;
  std::int64_t final_maps = 0;
  std::int64_t closed = 0;
  std::int64_t optimal = 0;
  std::int64_t perpendicular = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& counts) {
  return out << counts.tree_nodes << " nodes, " << counts.maps_built << " maps, "
             << counts.final_maps << " final, " << counts.closed << " closed, " << counts.optimal
             << " optimal, " << counts.perpendicular << " perpendicular";
}

Counts explore(const Lattice& streets, const std::string& moves, TopologyOptions options) {
  options.max_hypotheses = 10'000'000;
  HypothesisTree tree(options);
  const Walk walk = streets.walk(0, moves);
  EXPECT_TRUE(tree.start(walk.start).ok());
  for (const Experienced& step : walk.steps) {
    EXPECT_TRUE(tree.extend(step.action, step.view).ok());
  }
  EXPECT_FALSE(tree.guarantee_given_up());
  EXPECT_EQ(tree.waiting_count(), 0);
  Counts counts{tree.node_count(), tree.maps_built()};
  tree.for_each_map([&](const Hypothesis&, const TopologicalMap& map) {
    const bool is_closed = map.has_no_lone_path();
    ++counts.final_maps;
    counts.closed += is_closed ? 1 : 0;
    counts.perpendicular += is_closed && is_perpendicular(map) ? 1 : 0;
  });
  counts.optimal = static_cast<std::int64_t>(tree.simplest_closed().size());
  return counts;
}

TopologyOptions spatial() {
  TopologyOptions options;
  options.planar = false;
  return options;
}

// The column of the paper stands for this walk, not for the snake.
constexpr const char* kWalk3x4 = "ESSENNESSWWWNEEENWWWS";

TEST(SavelliKuipersFigure4, GridOf3x3) {
  EXPECT_EQ(explore({3, 3}, snake_moves(3, 3), spatial()), (Counts{317, 188, 88, 6, 2, 2}));
  EXPECT_EQ(explore({3, 3}, snake_moves(3, 3), {}), (Counts{240, 147, 62, 3, 1, 1}));
}

TEST(SavelliKuipersFigure4, GridOf3x4) {
  EXPECT_EQ(explore({3, 4}, kWalk3x4, spatial()), (Counts{4239, 3400, 1465, 16, 8, 8}));
  EXPECT_EQ(explore({3, 4}, kWalk3x4, {}), (Counts{1722, 1425, 507, 3, 1, 1}));
}

TEST(SavelliKuipersFigure4, GridOf4x4WithAtMost16PlacesInThePlane) {
  TopologyOptions options;
  options.max_places = 16;
  EXPECT_EQ(explore({4, 4}, snake_moves(4, 4), options), (Counts{8452, 4951, 545, 58, 2, 1}));
}

TEST(SavelliKuipersFigure4, GridOf4x4WithAtMost16PlacesWithoutPlanarity) {
  TopologyOptions options = spatial();
  options.max_places = 16;
  EXPECT_EQ(explore({4, 4}, snake_moves(4, 4), options),
            (Counts{192569, 93034, 23685, 6992, 2, 256}));
}

// Beyond the paper: what it says does not terminate in reasonable time, and larger grids.
TEST(SavelliKuipersFigure4, GridOf4x4WithoutABoundInThePlane) {
  EXPECT_EQ(explore({4, 4}, snake_moves(4, 4), {}), (Counts{223865, 164467, 49123, 58, 2, 1}));
}

TEST(SavelliKuipersFigure4, GridOf3x5) {
  EXPECT_EQ(explore({3, 5}, snake_moves(3, 5), spatial()),
            (Counts{178312, 132141, 37345, 192, 48, 48}));
  EXPECT_EQ(explore({3, 5}, snake_moves(3, 5), {}), (Counts{21931, 17732, 4274, 5, 1, 1}));
}

TEST(SavelliKuipersFigure4, GridOf4x5WithAtMost20PlacesInThePlane) {
  TopologyOptions options;
  options.max_places = 20;
  EXPECT_EQ(explore({4, 5}, snake_moves(4, 5), options), (Counts{247434, 208434, 1993, 4, 1, 1}));
}

}  // namespace
}  // namespace cairn::test
