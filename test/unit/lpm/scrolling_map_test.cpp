#include "lpm/scrolling_map.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;

ScrollingMapOptions small_window() {
  ScrollingMapOptions options;
  options.window_m = 24.0;
  options.cell_m = 0.1;
  options.memory_travel_m = 10.0;
  return options;
}

CellState state_at(const ScrollingMap& map, const Vector2d& p) {
  return map.grid().state(map.grid().geometry().cell_at(p));
}

/// One beam straight ahead.
LaserScan beam(float range_m) {
  LaserScan scan;
  scan.bearings_rad = {0.0F, 0.001F};
  scan.ranges_m = {range_m, range_m};
  scan.max_range_m = 8.0;
  return scan;
}

void expect_same(const DistanceField& field, const DistanceField& other) {
  const GridGeometry& geometry = field.geometry();
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      Cell wall;
      Cell other_wall;
      ASSERT_EQ(field.find_nearest({x, y}, &wall), other.find_nearest({x, y}, &other_wall));
      ASSERT_EQ(wall, other_wall) << x << " " << y;
    }
  }
}

TEST(ScrollingMap, ABeamFreesItsWayAndEndsInAWall) {
  ScrollingMap map(small_window());
  map.insert(beam(3.05F), Pose2(), 0.0);
  map.insert(beam(3.05F), Pose2(), 0.0);
  EXPECT_EQ(state_at(map, {0.05, 0.05}), CellState::kFree);
  EXPECT_EQ(state_at(map, {2.95, 0.0}), CellState::kFree);
  EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kOccupied);
  EXPECT_EQ(state_at(map, {3.25, 0.0}), CellState::kUnknown);
  EXPECT_NEAR(map.walls().distance_m(map.grid().geometry().cell_at({2.75, 0.05})), 0.3, 1e-9);
}

TEST(ScrollingMap, ABeamWithoutReturnFreesUpToTheFirstWall) {
  ScrollingMap map(small_window());
  for (int i = 0; i < 2; ++i) {
    map.insert(beam(std::numeric_limits<float>::infinity()), Pose2(), 0.0);
  }
  EXPECT_EQ(state_at(map, {7.85, 0.0}), CellState::kFree);
  EXPECT_EQ(state_at(map, {8.25, 0.0}), CellState::kUnknown);
  for (int i = 0; i < 4; ++i) {
    map.insert(beam(3.05F), Pose2(), 0.0);
  }
  for (int i = 0; i < 10; ++i) {
    map.insert(beam(std::numeric_limits<float>::infinity()), Pose2(), 0.0);
  }
  EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kOccupied);
}

TEST(ScrollingMap, ABeamThatSaysNothingChangesNothing) {
  ScrollingMap map(small_window());
  map.insert(beam(std::numeric_limits<float>::quiet_NaN()), Pose2(), 0.0);
  EXPECT_THAT(map.grid().cells(), ::testing::Each(0));
}

TEST(ScrollingMap, WhatHasMovedAwayFadesWithinNineScans) {
  ScrollingMap map(small_window());
  for (int i = 0; i < 100; ++i) {
    map.insert(beam(3.05F), Pose2(), 0.0);
  }
  for (int i = 0; i < 9; ++i) {
    map.insert(beam(5.05F), Pose2(), 0.0);
  }
  EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kFree);
  EXPECT_EQ(state_at(map, {5.05, 0.0}), CellState::kOccupied);
}

TEST(ScrollingMap, WhatHasMovedAwayIsAWallForAsManyScansAsStated) {
  const ScrollingMapOptions options = small_window();
  const int stated =
      static_cast<int>(std::ceil((options.max_log_odds - 0.4) / options.miss_log_odds));
  ASSERT_EQ(stated, 7);
  for (const int seen : {10, 1000}) {
    ScrollingMap map(options);
    for (int i = 0; i < seen; ++i) {
      map.insert(beam(3.05F), Pose2(), 0.0);
    }
    for (int i = 1; i < stated; ++i) {
      map.insert(beam(5.05F), Pose2(), 0.0);
    }
    EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kOccupied);
    map.insert(beam(5.05F), Pose2(), 0.0);
    EXPECT_NE(state_at(map, {3.05, 0.0}), CellState::kOccupied);
  }
}

TEST(ScrollingMap, ADarkSurfaceStaysWhereItSwallowsBeams) {
  ScrollingMap map(small_window());
  for (int i = 0; i < 5; ++i) {
    map.insert(beam(3.05F), Pose2(), 0.0);
  }
  for (int i = 0; i < 1000; ++i) {
    map.insert(beam(std::numeric_limits<float>::infinity()), Pose2(), 0.0);
  }
  EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kOccupied);
}

TEST(ScrollingMap, AWallOfGlassStaysWhereAFewBeamsGoThrough) {
  ScrollingMap map(small_window());
  for (int i = 0; i < 50; ++i) {
    map.insert(beam(3.05F), Pose2(), 0.0);
  }
  for (int i = 0; i < 5; ++i) {
    map.insert(beam(6.05F), Pose2(), 0.0);
  }
  EXPECT_EQ(state_at(map, {3.05, 0.0}), CellState::kOccupied);
}

TEST(ScrollingMap, KnowsWithinACellWhereTheSurfaceLiesAndWhichWayItFaces) {
  ScrollingMap map(small_window());
  SimulatedLaser laser({{{3.03, -5.0}, {3.03, 5.0}}});
  for (int i = 0; i < 20; ++i) {
    map.insert(laser.scan(Pose2(), 0.0), Pose2(), 0.0);
  }
  const Cell wall = map.grid().geometry().cell_at({3.03, 0.0});
  ASSERT_EQ(map.grid().state(wall), CellState::kOccupied);
  const SurfaceCell& surface = map.surface(wall);
  EXPECT_NEAR(map.grid().geometry().center_of(wall).x() + 0.1 * surface.x / 256.0, 3.03, 0.01);
  EXPECT_NEAR(std::abs(surface.angle) * kPi / 32768.0, kPi, 0.05) << "back to the laser";
}

TEST(ScrollingMap, OfFortyMetresInFiveCentimetresIsBelowEightMebibytes) {
  ScrollingMap map(ScrollingMapOptions{});
  SimulatedLaser laser(furnished_room());
  for (int i = 0; i < 40; ++i) {
    map.insert(laser.scan(Pose2(), 0.0), Pose2(0.3 * i, 0.0, 0.1 * i), 0.3 * i);
  }
  EXPECT_GE(map.grid().cells().size(), 640'000U);
  EXPECT_LT(map.memory_bytes(), 8U * 1024U * 1024U);
}

TEST(ScrollingMap, ScrollsWithoutMovingWhatItHolds) {
  ScrollingMap map(small_window());
  SimulatedLaser laser(furnished_room());
  for (int i = 0; i < 3; ++i) {
    map.insert(laser.scan(Pose2(), 0.0), Pose2(), 0.0);
  }
  ASSERT_EQ(state_at(map, {5.0, 0.5}), CellState::kOccupied);
  const Vector2d old_origin = map.grid().geometry().origin_m;
  map.insert(beam(2.0F), Pose2(6.0, 5.0, 1.5), 1.0);
  EXPECT_NE(map.grid().geometry().origin_m, old_origin);
  EXPECT_EQ(state_at(map, {5.0, 0.5}), CellState::kOccupied);
  EXPECT_EQ(map.grid().cells().size(), 240U * 240U);
  DistanceField anew(map.grid().geometry());
  anew.renew(map.grid(), {0, 0}, {239, 239});
  expect_same(map.walls(), anew);
}

TEST(ScrollingMap, ForgetsWhatWasNotSeenForSomeTravel) {
  ScrollingMap map(small_window());
  SimulatedLaser laser(furnished_room());
  for (int i = 0; i < 3; ++i) {
    map.insert(laser.scan(Pose2(), 0.0), Pose2(), 0.0);
  }
  map.insert(beam(2.0F), Pose2(0.0, 0.0, kPi), 9.0);
  EXPECT_EQ(state_at(map, {5.0, 0.5}), CellState::kOccupied);
  map.insert(beam(2.0F), Pose2(0.0, 0.0, kPi), 10.5);
  EXPECT_EQ(state_at(map, {5.0, 0.5}), CellState::kUnknown);
  EXPECT_EQ(state_at(map, {-1.5, 0.0}), CellState::kFree) << "seen meanwhile";
  DistanceField anew(map.grid().geometry());
  anew.renew(map.grid(), {0, 0}, {239, 239});
  expect_same(map.walls(), anew);
}

}  // namespace
}  // namespace cairn
