#include "region/furniture.hpp"

#include <gmock/gmock.h>

#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::grid_of;

const std::vector<std::string> kRoom = {"##########",  //
                                        "#        #",  //
                                        "# #  ##  #",  //
                                        "#    ??  #",  //
                                        "#       ##",  //
                                        "##########"};

TEST(Furniture, StandsFreeAndIsSmall) {
  const OccupancyGrid bare = without_furniture(grid_of(kRoom, 0.1), 0.2);
  EXPECT_EQ(bare.state({2, 3}), CellState::kFree);
  EXPECT_EQ(bare.state({5, 2}), CellState::kFree) << "unknown below a table top";
  EXPECT_EQ(bare.state({8, 1}), CellState::kOccupied) << "against the wall";
  EXPECT_EQ(bare.state({0, 0}), CellState::kOccupied);
}

TEST(Furniture, StaysWhereItIsLarger) {
  const OccupancyGrid bare = without_furniture(grid_of(kRoom, 0.1), 0.15);
  EXPECT_EQ(bare.state({2, 3}), CellState::kFree);
  EXPECT_EQ(bare.state({5, 2}), CellState::kUnknown);
  EXPECT_EQ(without_furniture(grid_of(kRoom, 0.1), 0.0).cells(), grid_of(kRoom, 0.1).cells());
}

TEST(Furniture, DoesNotReachTheBorderOfTheGrid) {
  const OccupancyGrid bare = without_furniture(grid_of({"#  ",  //
                                                        "   ",  //
                                                        "   "},
                                                       0.1),
                                               1.0);
  EXPECT_EQ(bare.state({0, 2}), CellState::kOccupied);
}

}  // namespace
}  // namespace cairn
