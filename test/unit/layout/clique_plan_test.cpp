#include "layout/clique_plan.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gmock/gmock.h>

namespace cairn {
namespace {

std::vector<std::vector<int>> chain(int length) {
  std::vector<std::vector<int>> neighbors(static_cast<std::size_t>(length));
  for (int i = 0; i + 1 < length; ++i) {
    neighbors[static_cast<std::size_t>(i)].push_back(i + 1);
    neighbors[static_cast<std::size_t>(i) + 1].push_back(i);
  }
  for (std::vector<int>& list : neighbors) {
    std::sort(list.begin(), list.end());
  }
  return neighbors;
}

int depth_of(const std::vector<CliqueShape>& shapes) {
  std::vector<int> depth(shapes.size(), 1);
  for (std::size_t i = shapes.size(); i-- > 0;) {
    if (shapes[i].parent >= 0) {
      depth[i] = depth[static_cast<std::size_t>(shapes[i].parent)] + 1;
    }
  }
  return *std::max_element(depth.begin(), depth.end());
}

TEST(CliquePlan, EliminatesEveryPlaceOnceBelowWhatItLeavesOver) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int size = 2 + static_cast<int>(random() % 60);
    std::vector<std::set<int>> graph(static_cast<std::size_t>(size));
    for (int i = 0; i < 2 * size; ++i) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(size));
      const int b = static_cast<int>(random() % static_cast<unsigned>(size));
      if (a != b) {
        graph[static_cast<std::size_t>(a)].insert(b);
        graph[static_cast<std::size_t>(b)].insert(a);
      }
    }
    std::vector<std::vector<int>> neighbors;
    for (const std::set<int>& list : graph) {
      neighbors.emplace_back(list.begin(), list.end());
    }
    const std::vector<CliqueShape> shapes =
        plan_cliques(neighbors, std::vector<char>(static_cast<std::size_t>(size), 0));
    std::vector<int> shape_of(static_cast<std::size_t>(size), -1);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      for (int slot = 0; slot < shapes[i].eliminated; ++slot) {
        int& shape =
            shape_of[static_cast<std::size_t>(shapes[i].places[static_cast<std::size_t>(slot)])];
        EXPECT_EQ(shape, -1);
        shape = static_cast<int>(i);
      }
    }
    EXPECT_THAT(shape_of, testing::Each(testing::Ge(0)));
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const CliqueShape& shape = shapes[i];
      const bool is_root = static_cast<std::size_t>(shape.eliminated) == shape.places.size();
      EXPECT_EQ(shape.parent < 0, is_root);
      if (!is_root) {
        ASSERT_GT(shape.parent, static_cast<int>(i));
        const std::vector<int>& above = shapes[static_cast<std::size_t>(shape.parent)].places;
        for (std::size_t slot = static_cast<std::size_t>(shape.eliminated);
             slot < shape.places.size(); ++slot) {
          EXPECT_THAT(above, testing::Contains(shape.places[slot]));
        }
      }
    }
  }
}

TEST(CliquePlan, OfAChainIsAShallowTree) {
  EXPECT_LT(depth_of(plan_cliques(chain(1000), std::vector<char>(1000, 0))), 30);
}

TEST(CliquePlan, PlacesThatComeLastAreInARoot) {
  std::vector<char> comes_last(100, 0);
  comes_last[0] = comes_last[60] = 1;
  const std::vector<CliqueShape> shapes = plan_cliques(chain(100), comes_last);
  EXPECT_EQ(shapes.back().parent, -1);
  EXPECT_THAT(shapes.back().places, testing::IsSupersetOf({0, 60}));
}

}  // namespace
}  // namespace cairn
