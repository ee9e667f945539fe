#include "grid/medial_axis.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grid/critical_points.hpp"
#include "support/ascii_grid.hpp"
#include "support/drawn_world.hpp"

namespace cairn {
namespace {

using test::DrawnWorld;
using test::grid_of;
using ::testing::SizeIs;

const std::vector<std::string> kJunction{
    "##################################",  //
    "##################################",  //
    "..................................",  //
    "..................................",  //
    "...............R..................",  //
    "..................................",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",  //
    "##############....################",
};

MedialAxis axis_of(const OccupancyGrid& grid, const Vector2d& start) {
  const DistanceTransform distances = distance_transform(grid);
  return medial_axis(distances, grid.geometry().cell_at(start), MedialAxisOptions{});
}

TEST(MedialAxis, OfARoughJunctionHasOneMeetingPointAndThreeEnds) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const DrawnWorld world(kJunction, 0.5, seed);
    const MedialAxis axis = axis_of(world.full_map(), world.position_of('R'));
    EXPECT_THAT(axis.edges, SizeIs(3));
    EXPECT_EQ(std::count_if(axis.nodes.begin(), axis.nodes.end(),
                            [](const AxisNode& node) { return node.edges.size() == 3; }),
              1);
    EXPECT_EQ(std::count_if(axis.nodes.begin(), axis.nodes.end(),
                            [](const AxisNode& node) { return node.end == AxisEnd::kBorder; }),
              3);
  }
}

TEST(MedialAxis, TellsABlockedEndFromOneInUnknownSpace) {
  const OccupancyGrid corridor = grid_of({"########################",  //
                                          "#......................?",  //
                                          "#......................?",  //
                                          "#......................?",  //
                                          "#......................?",  //
                                          "#......................?",  //
                                          "########################",  //
                                          "????????????????????????"},
                                         0.25);
  const MedialAxis axis = axis_of(corridor, {2.0, 1.0});
  ASSERT_THAT(axis.nodes, SizeIs(2));
  ASSERT_THAT(axis.edges, SizeIs(1));
  const bool first_is_left = axis.nodes[0].cell.x < axis.nodes[1].cell.x;
  EXPECT_EQ(axis.nodes[first_is_left ? 0 : 1].end, AxisEnd::kBlocked);
  EXPECT_EQ(axis.nodes[first_is_left ? 1 : 0].end, AxisEnd::kUnknown);
}

TEST(MedialAxis, StaysInTheRoomOfTheRobot) {
  const OccupancyGrid rooms = grid_of({"#############",  //
                                       "#.....#.....#",  //
                                       "#.....#.....#",  //
                                       "#.....#.....#",  //
                                       "#############"},
                                      0.5);
  const MedialAxis axis = axis_of(rooms, {5.0, 1.0});
  ASSERT_FALSE(axis.nodes.empty());
  for (const AxisNode& node : axis.nodes) {
    EXPECT_GT(node.cell.x, 6);
  }
}

TEST(MedialAxis, IsEmptyWhereTheRobotDoesNotFit) {
  const OccupancyGrid crack = grid_of({"#######", ".......", "#######"}, 0.1);
  EXPECT_TRUE(axis_of(crack, {0.3, 0.1}).nodes.empty());
}

TEST(MedialAxis, RunsAroundAPillar) {
  const OccupancyGrid hall = grid_of({"###########",  //
                                      "#.........#",  //
                                      "#.........#",  //
                                      "#....#....#",  //
                                      "#.........#",  //
                                      "#.........#",  //
                                      "###########"},
                                     0.5);
  const MedialAxis axis = axis_of(hall, {1.0, 1.0});
  EXPECT_EQ(axis.edges.size(), axis.nodes.size());  // one loop
}

TEST(CriticalPoints, LieInTheDoorwayBetweenTwoRooms) {
  const OccupancyGrid rooms = grid_of({"#####################",  //
                                       "#.........#.........#",  //
                                       "#.........#.........#",  //
                                       "#.........#.........#",  //
                                       "#...................#",  //
                                       "#...................#",  //
                                       "#...................#",  //
                                       "#.........#.........#",  //
                                       "#.........#.........#",  //
                                       "#.........#.........#",  //
                                       "#####################"},
                                      0.3);
  const DistanceTransform distances = distance_transform(rooms);
  const MedialAxis axis = medial_axis(distances, {3, 5}, MedialAxisOptions{});
  const auto points = critical_points(distances, axis, CriticalPointOptions{});
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_EQ(points[0].cell, (Cell{10, 5}));
  EXPECT_THAT(points[0].basis_points, ::testing::UnorderedElementsAre(Cell{10, 3}, Cell{10, 7}));
}

TEST(CriticalPoints, ARoughCorridorHasNone) {
  const std::vector<std::string> corridor{"########################",  //
                                          "........................",  //
                                          "........................",  //
                                          "........................",  //
                                          "........................",  //
                                          "########################"};
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const DrawnWorld world(corridor, 0.5, seed);
    const OccupancyGrid map = world.full_map();
    const DistanceTransform distances = distance_transform(map);
    const MedialAxis axis =
        medial_axis(distances, map.geometry().cell_at({6.0, 1.5}), MedialAxisOptions{});
    EXPECT_THAT(critical_points(distances, axis, CriticalPointOptions{}), SizeIs(0));
  }
}

}  // namespace
}  // namespace cairn
