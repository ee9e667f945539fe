#include "place/island.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/drawn_world.hpp"

namespace cairn {
namespace {

VisibleWall wall(double bearing_rad, double influence) {
  return {{std::cos(bearing_rad), std::sin(bearing_rad)}, influence, 2.0};
}

TEST(IslandMeasure, NoWallsTellNothing) {
  EXPECT_EQ(island_measure({}).distinctiveness, 0.0);
}

TEST(IslandMeasure, ParallelWallsLeaveOneDirectionOpen) {
  const IslandMeasure corridor = island_measure({wall(0.3, 1.5), wall(0.3 + kPi, 1.5)});
  EXPECT_NEAR(corridor.dominating, 3.0, 1e-12);
  EXPECT_NEAR(corridor.weaker, 0.0, 1e-12);
  EXPECT_NEAR(corridor.distinctiveness, 0.0, 1e-9);
}

TEST(IslandMeasure, WallsOfTwoOrthogonalDirectionsTellAll) {
  const IslandMeasure room = island_measure({wall(0.3, 1.5), wall(0.3 + kPi / 2.0, 1.5)});
  EXPECT_NEAR(room.quality, 1.0, 1e-12);
  EXPECT_GT(room.distinctiveness, 0.95);
}

TEST(IslandMeasure, TheSmallerConstraintDecidesAndTheQualityCounts) {
  const auto with_end = [](double influence) {
    return island_measure({wall(0.0, 1.5), wall(kPi, 1.5), wall(kPi / 2.0, influence)})
        .distinctiveness;
  };
  EXPECT_LT(with_end(0.1), 0.1);
  EXPECT_LT(with_end(0.1), with_end(0.4));
  EXPECT_LT(with_end(0.4), with_end(1.5));
}

TEST(IslandMeasure, DoesNotDependOnTheFrame) {
  const std::vector<VisibleWall> walls{wall(0.0, 1.5), wall(0.9, 0.8), wall(2.4, 0.3)};
  std::vector<VisibleWall> turned;
  for (const VisibleWall& one : walls) {
    turned.push_back(one);
    turned.back().normal = Pose2(0.0, 0.0, 1.1) * one.normal;
  }
  EXPECT_NEAR(island_measure(walls).distinctiveness, island_measure(turned).distinctiveness, 1e-12);
}

TEST(IslandMeasure, ScatteredHitsDoNotTellTheHeading) {
  std::vector<VisibleWall> round;
  for (int i = 0; i < 12; ++i) {
    round.push_back({{std::cos(kPi * i / 6.0), std::sin(kPi * i / 6.0)}, 0.3, 0.02});
  }
  EXPECT_LT(island_measure(round).distinctiveness, 0.1);
}

/// A corridor 40 m long with a side corridor at its middle and a corner at its right end.
const std::vector<std::string> kCorridor{
    "######################################################################################",  //
    "#....................................................................................#",  //
    "#..C....................O..................J......................................L..#",  //
    "#....................................................................................#",  //
    "#....................................................................................#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "#########################################.....##################################.....#",  //
    "######################################################################################",
};

class Corridor : public ::testing::TestWithParam<unsigned> {
 protected:
  [[nodiscard]] double at(char mark) const { return at(world_.position_of(mark)); }
  [[nodiscard]] double at(const Vector2d& p) const {
    const OccupancyGrid map = world_.full_map();
    const PlaceOptions options;
    LocalViewer viewer;
    return island_at(viewer.look_around(map, p, options, options.min_corner_rad), p)
        .distinctiveness;
  }
  test::DrawnWorld world_{kCorridor, 0.5, GetParam()};
};

TEST_P(Corridor, JunctionsAndCornersAreIslandsAndTheOpenCorridorIsNone) {
  EXPECT_LT(at('O'), 0.2);
  EXPECT_GT(at('J'), at('O') + 0.2);
  EXPECT_GT(at('L'), at('O') + 0.2);
  EXPECT_GT(at('C'), at('O') + 0.2);
}

TEST_P(Corridor, APointThatIsNotFreeIsNoIsland) {
  EXPECT_EQ(at(Vector2d(0.1, 0.1)), 0.0);
}

INSTANTIATE_TEST_SUITE_P(RoughWalls, Corridor, ::testing::Range(0U, 5U));

}  // namespace
}  // namespace cairn
