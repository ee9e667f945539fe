#include "region/region_graph.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "support/floor_plan_grid.hpp"

namespace cairn {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Drawing = std::vector<std::string>;

/// A character is a quarter of a metre.
OccupancyGrid plan(const Drawing& drawing) {
  return test::enlarged_grid_of(drawing, 5, 0.05);
}

RegionGraph graph_of(const OccupancyGrid& grid) {
  return region_graph(grid, RegionOptions{});
}

const Drawing kTwoRooms = {"###########################",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "###########################"};

const Drawing kCorridor = {"###########################",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "###    ############    ####",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "#                         #",  //
                           "##    ##############    ###",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "#            #            #",  //
                           "###########################"};

const Drawing kCrossing = {"#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "                       ",  //
                           "                       ",  //
                           "                       ",  //
                           "                       ",  //
                           "                       ",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########",  //
                           "#########     #########"};

/// Three cubicles open to an aisle, with openings hardly narrower than the cubicles.
const Drawing kCubicles = {"######################################",  //
                           "#           #            #           #",  //
                           "#           #            #           #",  //
                           "#           #            #           #",  //
                           "#           #            #           #",  //
                           "#           #            #           #",  //
                           "#           #            #           #",  //
                           "###       #####        #####       ###",  //
                           "#                                    #",  //
                           "#                                    #",  //
                           "#                                    #",  //
                           "#                                    #",  //
                           "#                                    #",  //
                           "######################################"};

TEST(RegionGraph, TwoRoomsAreJoinedByALineAsWideAsTheDoor) {
  const RegionGraph graph = graph_of(plan(kTwoRooms));
  ASSERT_THAT(graph.regions, SizeIs(2));
  ASSERT_THAT(graph.lines, SizeIs(1));
  const CriticalLine& door = graph.lines.front();
  EXPECT_EQ(door.from, 0U);
  EXPECT_EQ(door.to, 1U);
  EXPECT_NEAR(door.width_m, 1.0, 0.051);
  EXPECT_NEAR(door.critical_point.x, 67, 3);
  EXPECT_NEAR(door.critical_point.y, 29, 2);
  for (const Region& room : graph.regions) {
    EXPECT_NEAR(room.area_m2, 3.0 * 2.5, 0.3);
    EXPECT_NEAR(room.clearance_m, 1.25, 0.051);
    EXPECT_THAT(room.lines, ElementsAre(0));
  }
}

TEST(RegionGraph, ACorridorIsARegionWithALineToEveryRoom) {
  const RegionGraph graph = graph_of(plan(kCorridor));
  ASSERT_THAT(graph.regions, SizeIs(5));
  ASSERT_THAT(graph.lines, SizeIs(4));
  const auto corridor = static_cast<std::size_t>(graph.region_at({65, 50}));
  EXPECT_THAT(graph.regions[corridor].lines, ElementsAre(0, 1, 2, 3));
  for (const CriticalLine& line : graph.lines) {
    EXPECT_NEAR(line.width_m, 1.0, 0.051);
  }
}

TEST(RegionGraph, CorridorsThatCrossAreOneRegion) {
  EXPECT_THAT(graph_of(plan(kCrossing)).regions, SizeIs(1));
}

TEST(RegionGraph, OpeningsNearlyAsWideAsTheCubicleAreLines) {
  const RegionGraph graph = graph_of(plan(kCubicles));
  EXPECT_THAT(graph.regions, SizeIs(4));
  EXPECT_THAT(graph.lines, SizeIs(3));
}

TEST(RegionGraph, NeedsNoDoorForALineAcrossANarrowing) {
  // A passage of 1.5 m between two halls, too deep for a doorway.
  Drawing halls(24, "#                        ####            ");
  halls.front() = halls.back() = std::string(halls.front().size(), '#');
  for (std::string& line : halls) {
    line = line.substr(0, 25) + "############" + std::string(24, ' ') + "#";
  }
  for (std::size_t y = 9; y < 15; ++y) {
    halls[y].replace(25, 12, 12, ' ');
  }
  halls.front() = halls.back() = std::string(halls.front().size(), '#');
  EXPECT_THAT(graph_of(plan(halls)).regions, SizeIs(2));
}

TEST(RegionGraph, FurnitureThatStandsFreeDividesNothingAndBelongsToItsRoom) {
  OccupancyGrid grid = plan(kTwoRooms);
  // Four legs of a table, half a metre apart, and a stool beside the door.
  for (const Cell leg : {Cell{20, 20}, Cell{30, 20}, Cell{20, 30}, Cell{30, 30}, Cell{58, 30}}) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        grid.log_odds({leg.x + x, leg.y + y}) = 300;
      }
    }
  }
  const RegionGraph bare = graph_of(plan(kTwoRooms));
  const RegionGraph graph = graph_of(grid);
  EXPECT_EQ(graph.region_of, bare.region_of);
  EXPECT_THAT(graph.lines, SizeIs(1));
}

TEST(RegionGraph, TwoDoorsBetweenTwoRoomsAreTwoLines) {
  Drawing drawing(30, "#            #            #");
  drawing.front() = drawing.back() = std::string(27, '#');
  for (const std::size_t y : {4U, 5U, 6U, 7U, 20U, 21U, 22U, 23U}) {
    drawing[y][13] = ' ';
  }
  const RegionGraph graph = graph_of(plan(drawing));
  EXPECT_THAT(graph.regions, SizeIs(2));
  EXPECT_THAT(graph.lines, SizeIs(2));
}

TEST(RegionGraph, IsEmptyWhereNothingIsFree) {
  for (const char fill : {'#', '?'}) {
    const RegionGraph graph = graph_of(plan(Drawing(10, std::string(12, fill))));
    EXPECT_THAT(graph.regions, IsEmpty());
    EXPECT_THAT(graph.lines, IsEmpty());
    EXPECT_THAT(graph.region_of, Each(RegionGraph::kNoRegion));
  }
  EXPECT_THAT(graph_of(OccupancyGrid()).regions, IsEmpty());
}

TEST(RegionGraph, IsOneRegionWhereNothingBounds) {
  const RegionGraph graph = graph_of(plan(Drawing(10, std::string(12, ' '))));
  ASSERT_THAT(graph.regions, SizeIs(1));
  EXPECT_THAT(graph.lines, IsEmpty());
  EXPECT_THAT(graph.region_of, Each(0));
  EXPECT_NEAR(graph.regions.front().area_m2, 2.5 * 3.0, 1e-9);
}

TEST(RegionGraph, RoomsAtBothEndsOfAOneCellCorridorAreParted) {
  Drawing drawing(50, std::string(130, ' '));
  for (std::size_t y = 0; y < drawing.size(); ++y) {
    drawing[y].replace(50, 30, 30, '#');
  }
  drawing[25].replace(50, 30, 30, ' ');
  const RegionGraph graph = graph_of(test::grid_of(drawing, 0.05));
  EXPECT_THAT(graph.regions, SizeIs(2));
  ASSERT_THAT(graph.lines, SizeIs(1));
  EXPECT_NEAR(graph.lines.front().width_m, 0.05, 1e-9);
}

TEST(RegionGraph, AMazeOfOneCellCorridorsHasNoRoomInIt) {
  Drawing drawing(60, std::string(60, ' '));
  for (std::size_t y = 0; y < drawing.size(); y += 4) {
    for (std::size_t x = 0; x < 60; ++x) {
      drawing[y][x] = x % 12 == (y % 8 == 0 ? 0U : 6U) ? ' ' : '#';
    }
    for (std::size_t x = 2; x < 60; x += 2) {
      for (std::size_t row = y; row < y + 4; ++row) {
        drawing[row][x] = row % 4 == 1 ? ' ' : '#';
      }
    }
  }
  const RegionGraph graph = graph_of(test::grid_of(drawing, 0.05));
  for (const Region& region : graph.regions) {
    EXPECT_LE(region.clearance_m, 0.11);
  }
}

TEST(RegionGraph, IsTheSameHoweverTheMapIsTurned) {
  for (const Drawing& drawing : {kTwoRooms, kCorridor, kCrossing, kCubicles}) {
    const RegionGraph straight = graph_of(plan(drawing));
    for (int way = 1; way < 8; ++way) {
      SCOPED_TRACE(way);
      const RegionGraph graph = graph_of(plan(test::turned(drawing, way)));
      EXPECT_EQ(graph.regions.size(), straight.regions.size());
      EXPECT_EQ(graph.lines.size(), straight.lines.size());
    }
  }
}

TEST(RegionGraph, IsTheSameWithFinerAndCoarserCells) {
  for (const Drawing& drawing : {kTwoRooms, kCorridor, kCrossing, kCubicles}) {
    const RegionGraph fine = graph_of(test::enlarged_grid_of(drawing, 10, 0.025));
    const RegionGraph coarse = graph_of(test::enlarged_grid_of(drawing, 3, 0.25 / 3.0));
    EXPECT_EQ(fine.regions.size(), coarse.regions.size());
    EXPECT_EQ(fine.lines.size(), coarse.lines.size());
  }
}

TEST(RegionGraph, FindsTheRoomsOfFloorsSplitAtRandom) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const test::RandomFloor floor = test::RandomFloorMaker(seed, 56, 11, 4).make();
    const OccupancyGrid grid = plan(floor.drawing);
    const RegionGraph graph = graph_of(grid);
    EXPECT_EQ(static_cast<int>(graph.regions.size()), floor.rooms);
    EXPECT_EQ(graph_of(grid).region_of, graph.region_of);
    for (const CriticalLine& line : graph.lines) {
      EXPECT_LT(line.from, line.to);
      EXPECT_EQ(grid.state(line.critical_point), CellState::kFree);
      EXPECT_EQ(grid.state(line.basis_points[0]), CellState::kOccupied);
      EXPECT_EQ(grid.state(line.basis_points[1]), CellState::kOccupied);
      EXPECT_NEAR(line.width_m, 1.0, 0.051);
    }
  }
}

TEST(RegionOptions, NameWhatIsOutOfRange) {
  EXPECT_TRUE(validate(RegionOptions{}).ok());
  RegionOptions options;
  options.max_line_m = 0.0;
  options.max_narrowing = 1.5;
  options.widening = -1.0;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("regions.max_line_m"));
  EXPECT_THAT(status.error().message, HasSubstr("max_narrowing"));
  EXPECT_THAT(status.error().message, HasSubstr("widening"));
}

}  // namespace
}  // namespace cairn
