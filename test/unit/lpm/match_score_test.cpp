#include "lpm/match_score.hpp"

#include <gtest/gtest.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::add_box;
using test::SimulatedLaser;
using test::Wall;

std::vector<Wall> room(double half_m) {
  std::vector<Wall> walls;
  add_box({-half_m, -half_m}, {half_m, half_m}, &walls);
  return walls;
}

ScanBeams beams_in(double half_m, const Pose2& pose) {
  SimulatedLaser laser(room(half_m));
  ScanBeams beams;
  beams.take(laser.scan(pose, 0.0), {}, 30.0);
  return beams;
}

/// A room of 6 m x 6 m, seen from its middle often enough for its walls to face somewhere.
ScrollingMap map_of_a_room() {
  ScrollingMap map({});
  for (int i = 0; i < 5; ++i) {
    map.insert(beams_in(3.0, Pose2()), Pose2(), 0.0);
  }
  return map;
}

TEST(ShareThroughWalls, IsNoneWhereTheRobotIsRight) {
  EXPECT_LT(share_through_walls(map_of_a_room(), beams_in(3.0, Pose2()), Pose2()), 0.02);
}

TEST(ShareThroughWalls, IsAllOfThemInALargerRoom) {
  EXPECT_GT(share_through_walls(map_of_a_room(), beams_in(5.0, Pose2()), Pose2()), 0.95);
}

TEST(ShareThroughWalls, ForgivesWhatIsBehindAWallByLittle) {
  EXPECT_LT(share_through_walls(map_of_a_room(), beams_in(3.2, Pose2()), Pose2()), 0.1);
}

TEST(ShareThroughWalls, IsNoneInASmallerRoomWhoseBeamsEndBeforeTheWalls) {
  EXPECT_LT(share_through_walls(map_of_a_room(), beams_in(1.5, Pose2()), Pose2()), 0.02);
}

}  // namespace
}  // namespace cairn
