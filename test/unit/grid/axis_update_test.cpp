#include "grid/axis_update.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "grid/distance_update.hpp"
#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::grid_of;

/// A larger floor of which a window is looked at.
class Floor {
 public:
  static constexpr int kSide = 120;
  static constexpr int kWindow = 60;

  explicit Floor(unsigned seed) : random_(seed) {
    for (int i = 0; i < 25; ++i) {
      draw();
    }
  }

  int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  /// A stretch of wall, of unknown cells, or of free ones.
  void draw() {
    const int length = 1 + pick(30);
    const bool is_along_x = pick(2) == 0;
    const Cell from{pick(kSide), pick(kSide)};
    const CellState state = std::array{CellState::kOccupied, CellState::kUnknown,
                                       CellState::kFree}[static_cast<std::size_t>(pick(3))];
    for (int i = 0; i < length; ++i) {
      const Cell c{std::min(from.x + (is_along_x ? i : 0), kSide - 1),
                   std::min(from.y + (is_along_x ? 0 : i), kSide - 1)};
      cells_[index_of(c)] = state;
    }
  }

  [[nodiscard]] StateGrid window(Cell lower) const {
    GridGeometry geometry;
    geometry.cell_m = 0.1;
    geometry.width = geometry.height = kWindow;
    StateGrid grid(geometry);
    for (int y = 0; y < kWindow; ++y) {
      for (int x = 0; x < kWindow; ++x) {
        grid.cells()[geometry.index_of({x, y})] = cells_[index_of({lower.x + x, lower.y + y})];
      }
    }
    return grid;
  }

 private:
  [[nodiscard]] static std::size_t index_of(Cell c) {
    return static_cast<std::size_t>(c.y) * kSide + static_cast<std::size_t>(c.x);
  }

  std::mt19937 random_;
  std::vector<CellState> cells_ = std::vector<CellState>(kSide * kSide, CellState::kFree);
};

void expect_equal(const DistanceTransform& one, const DistanceTransform& other) {
  ASSERT_EQ(one.states(), other.states());
  ASSERT_EQ(one.squared_clearances_cells(), other.squared_clearances_cells());
  ASSERT_EQ(one.basis_offsets(), other.basis_offsets());
}

void expect_equal(const MedialAxis& one, const MedialAxis& other) {
  ASSERT_EQ(one.nodes.size(), other.nodes.size());
  for (std::size_t n = 0; n < one.nodes.size(); ++n) {
    ASSERT_EQ(one.nodes[n].cell, other.nodes[n].cell);
    ASSERT_EQ(one.nodes[n].end, other.nodes[n].end);
    ASSERT_EQ(one.nodes[n].edges, other.nodes[n].edges);
    ASSERT_EQ(one.nodes[n].clearance_m, other.nodes[n].clearance_m);
  }
  ASSERT_EQ(one.edges.size(), other.edges.size());
  for (std::size_t e = 0; e < one.edges.size(); ++e) {
    ASSERT_EQ(one.edges[e].cells, other.edges[e].cells);
    ASSERT_EQ(one.edges[e].clearance_m, other.edges[e].clearance_m);
  }
}

TEST(AxisUpdate, WhateverChangesIsWhatAFullComputationGives) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Floor floor(seed);
    DistanceUpdate distances;
    AxisUpdate axis;
    Cell lower{30, 30};
    for (int step = 0; step < 25; ++step) {
      SCOPED_TRACE(step);
      const Cell before = lower;
      for (int i = floor.pick(3); i > 0; --i) {
        floor.draw();
      }
      if (floor.pick(3) > 0) {
        lower.x = std::clamp(lower.x + floor.pick(5) - 2, 0, Floor::kSide - Floor::kWindow);
        lower.y = std::clamp(lower.y + floor.pick(5) - 2, 0, Floor::kSide - Floor::kWindow);
      }
      const Cell moved{step == 0 ? 0 : lower.x - before.x, step == 0 ? 0 : lower.y - before.y};
      const StateGrid grid = floor.window(lower);
      distances.update(grid, moved);
      const DistanceTransform full = distance_transform(grid);
      ASSERT_NO_FATAL_FAILURE(expect_equal(distances.distances(), full));
      const Cell start{30, 30};
      ASSERT_NO_FATAL_FAILURE(
          expect_equal(axis.next(distances.distances(), distances.changed(), moved, start, {}),
                       medial_axis(full, start, {})));
    }
  }
}

TEST(AxisUpdate, NothingIsNewWhereNothingHasChanged) {
  const Floor floor(1);
  DistanceUpdate distances;
  distances.update(floor.window({20, 20}), {});
  EXPECT_FALSE(distances.changed().empty());
  distances.update(floor.window({20, 20}), {});
  EXPECT_TRUE(distances.changed().empty());
}

TEST(AxisUpdate, FollowsWhenAllBecomesUnknownFreeOrWall) {
  DistanceUpdate distances;
  AxisUpdate axis;
  for (const char* all : {".....", "?????", "#####", ".....", "##.##"}) {
    const OccupancyGrid drawn = grid_of(std::vector<std::string>(5, all), 1.0);
    StateGrid states(drawn.geometry());
    for (std::size_t i = 0; i < states.cells().size(); ++i) {
      states.cells()[i] = drawn.state({static_cast<int>(i % 5), static_cast<int>(i / 5)});
    }
    distances.update(states, {});
    const DistanceTransform full = distance_transform(drawn);
    ASSERT_NO_FATAL_FAILURE(expect_equal(distances.distances(), full));
    ASSERT_NO_FATAL_FAILURE(
        expect_equal(axis.next(distances.distances(), distances.changed(), {}, {2, 2}, {}),
                     medial_axis(full, {2, 2}, {})));
  }
}

TEST(AxisUpdate, OneNoisyWallCellRaisesNoBranch) {
  const std::vector<std::string> corridor{
      "##############################", "..............................",
      "..............................", "..............................",
      "..............................", "##############################"};
  const auto edges_of = [](const std::vector<std::string>& drawn) {
    return medial_axis(distance_transform(grid_of(drawn, 0.5)), {5, 2}, {}).edges.size();
  };
  ASSERT_EQ(edges_of(corridor), 1U);
  for (std::size_t x = 1; x + 1 < corridor.front().size(); ++x) {
    SCOPED_TRACE(x);
    std::vector<std::string> bump = corridor;
    bump[1][x] = '#';
    EXPECT_EQ(edges_of(bump), 1U);
    std::vector<std::string> notch = corridor;
    notch[0][x] = '.';
    EXPECT_EQ(edges_of(notch), 1U);
  }
}

TEST(AxisUpdate, EveryAxisCellHasItsOwnClearance) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const DistanceTransform full = distance_transform(Floor(seed).window({20, 20}));
    for (const AxisEdge& edge : medial_axis(full, {30, 30}, {}).edges) {
      ASSERT_EQ(edge.cells.size(), edge.clearance_m.size());
      for (std::size_t i = 0; i < edge.cells.size(); ++i) {
        EXPECT_EQ(edge.clearance_m[i], full.clearance_m(edge.cells[i]));
        EXPECT_NE(full.state(full.basis_point(edge.cells[i])), CellState::kFree);
      }
    }
  }
}

TEST(AxisUpdate, ACorridorOfTwoCellsHasALineOfOne) {
  const OccupancyGrid corridor =
      grid_of({"############", "............", "............", "############"}, 1.0);
  const MedialAxis axis = medial_axis(distance_transform(corridor), {5, 1}, {});
  ASSERT_EQ(axis.edges.size(), 1U);
  EXPECT_EQ(axis.edges[0].cells.size(), 12U);
}

TEST(AxisUpdate, TheEdgeOfTheGridCutsACorridorAndEndsItsAxisThere) {
  const OccupancyGrid corridor = grid_of(
      {"############", "............", "............", "............", "############"}, 0.5);
  const MedialAxis axis = medial_axis(distance_transform(corridor), {5, 2}, {});
  ASSERT_EQ(axis.nodes.size(), 2U);
  EXPECT_EQ(axis.nodes[0].end, AxisEnd::kBorder);
  EXPECT_EQ(axis.nodes[1].end, AxisEnd::kBorder);
}

}  // namespace
}  // namespace cairn
