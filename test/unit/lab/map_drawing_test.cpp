#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "bench/lab/codes.hpp"
#include "bench/lab/map_files.hpp"
#include "bench/lab/map_layout.hpp"
#include "bench/lab/tree_nodes.hpp"
#include "bench/lab/worlds/world.hpp"

namespace cairn::lab {
namespace {

using testing::HasSubstr;

Exploration grid_exploration(int rows, int columns, const std::string& moves) {
  return walk_grid(grid_world(rows, columns), 0, moves)->exploration;
}

DrawnMap drawn_grid(int rows, int columns) {
  const Exploration exploration = grid_exploration(rows, columns, snake_moves(rows, columns));
  ExactSearchOptions options;
  options.planar = true;
  options.perpendicular = true;
  const Enumeration all = enumerate(exploration, options);
  return drawn_map(all.counts.optimal->codes.front(), exploration, "a grid");
}

TEST(DrawnMap, HasThePlacesLinksAndPathsOfItsCode) {
  const DrawnMap map = drawn_grid(3, 3);
  EXPECT_EQ(map.places.size(), 9U);
  EXPECT_EQ(map.links.size(), 12U);
  EXPECT_EQ(map.path_count, 6);
  std::multiset<std::string> stars;
  for (const DrawnPlace& place : map.places) {
    stars.insert(place.star);
  }
  EXPECT_EQ(stars, (std::multiset<std::string>{"+", "L", "L", "L", "L", "T", "T", "T", "T"}));
}

// What the robot did, done again in the drawn map, leads through it with the same numbers.
TEST(DrawnMap, NumbersGatewaysAsTheStarsDo) {
  const Exploration exploration = grid_exploration(3, 3, snake_moves(3, 3));
  const DrawnMap map = drawn_grid(3, 3);
  const auto across = [&map](std::pair<int, int> from) {
    for (const DrawnLink& link : map.links) {
      if (from == std::pair(link.from_place, link.from_gateway)) {
        return std::pair(link.to_place, link.to_gateway);
      }
      if (from == std::pair(link.to_place, link.to_gateway)) {
        return std::pair(link.from_place, link.from_gateway);
      }
    }
    return std::pair(-1, -1);
  };
  std::set<std::pair<int, int>> ends;
  for (int start = 0; start < static_cast<int>(map.places.size()); ++start) {
    std::pair at(start, exploration.start_gateway);
    bool agrees = map.places[static_cast<std::size_t>(start)].star == "L";
    for (const ExplorationStep& step : exploration.steps) {
      const int gateways =
          agrees
              ? static_cast<int>(map.places[static_cast<std::size_t>(at.first)].is_pending.size())
              : 1;
      at = across({at.first, (at.second + step.turn) % gateways});
      // In a grid all visits to a place see the same star with the same numbers.
      agrees = agrees && at.first >= 0 && at.second == step.arrival_gateway;
    }
    if (agrees) {
      ends.insert(at);
    }
  }
  EXPECT_EQ(ends, (std::set{std::pair(map.robot_place, map.robot_gateway)}));
}

TEST(DrawnMap, KeepsWhatIsPending) {
  const Exploration exploration = grid_exploration(2, 2, "E");
  const DrawnMap map = drawn_map("L1[1.0 -]L0[0.0 -]", exploration, "");
  ASSERT_EQ(map.places.size(), 2U);
  EXPECT_TRUE(map.places[0].is_pending[0]);
  EXPECT_FALSE(map.places[0].is_pending[1]);
  EXPECT_EQ(map.robot_gateway, 1);
  EXPECT_EQ(map.path_count, 3);
  EXPECT_THAT(map_svg(map), HasSubstr("stroke-dasharray"));
  EXPECT_THAT(map_graphml(map), HasSubstr("<data key=\"pending_gateways\">1</data>"));
}

TEST(MapLayout, DrawsAGridAsAGrid) {
  const DrawnMap map = drawn_grid(4, 3);
  const std::vector<DrawnPosition> positions = laid_out(map);
  for (const DrawnLink& link : map.links) {
    const DrawnPosition& a = positions[static_cast<std::size_t>(link.from_place)];
    const DrawnPosition& b = positions[static_cast<std::size_t>(link.to_place)];
    const double across = std::abs(b.x - a.x);
    const double down = std::abs(b.y - a.y);
    EXPECT_NEAR(std::max(across, down), 1.0, 0.1);
    EXPECT_NEAR(std::min(across, down), 0.0, 0.1);
  }
}

TEST(MapLayout, DrawsALonePlace) {
  const Exploration exploration = grid_exploration(2, 2, "");
  const DrawnMap map = drawn_map("L0[- -]", exploration, "");
  EXPECT_EQ(laid_out(map).size(), 1U);
  EXPECT_THAT(map_svg(map), HasSubstr("place 0, star L, the robot is here"));
  EXPECT_THAT(map_dot(map), HasSubstr("p0g1 [label=\"?\""));
}

TEST(Codes, RenameTheirViews) {
  EXPECT_EQ(renamed_code("L1[1.0 -]g3x3g3x3g3x30[0.0 - -]", {{"g3x3g3x3g3x30", "Y0"}}),
            "L1[1.0 -]Y0[0.0 - -]");
}

TEST(TreeDot, ShowsEveryNodeAndWhatBecameOfIt) {
  const Exploration exploration = grid_exploration(2, 2, "ESWN");
  const std::vector<TreeNode> nodes = nodes_of_tree(exploration, {});
  EXPECT_EQ(nodes.size(), 11U);
  const std::string dot = tree_dot(nodes, "square \"loop\"");
  EXPECT_THAT(dot, HasSubstr("label=\"square \\\"loop\\\"\""));
  EXPECT_THAT(dot, HasSubstr("n0 [label=\"start\"]"));
  EXPECT_THAT(dot, HasSubstr("fillcolor"));
  for (const TreeNode& node : nodes) {
    EXPECT_LT(node.parent, node.id);
  }
}

}  // namespace
}  // namespace cairn::lab
