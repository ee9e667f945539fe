#include "lpm/map_matching.hpp"

#include <gmock/gmock.h>

#include "lpm/scrolling_map.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;
using test::Wall;

/// A map of a world, drawn from some poses; its frame lies at T_world_map.
OccupancyGrid map_of(const std::vector<Wall>& world, const Pose2& T_world_map, unsigned seed) {
  ScrollingMapOptions options;
  options.window_m = 24.0;
  ScrollingMap map(options);
  SimulatedLaser laser(world, seed);
  for (int i = 0; i < 12; ++i) {
    const Pose2 T_world_robot(0.1 * i, -0.05 * i, 0.6 * i);
    map.insert(laser.scan(T_world_robot, 0.0), T_world_map.inverse() * T_world_robot, 0.0);
  }
  return map.grid();
}

std::vector<Wall> another_room() {
  std::vector<Wall> walls;
  add_box({-3.0, -5.0}, {6.0, 2.2}, &walls);
  add_box({-1.0, -4.0}, {0.0, -3.0}, &walls);
  walls.push_back({{3.0, -5.0}, {6.0, -2.0}});
  return walls;
}

TEST(MapMatching, FindsHowOneMapOfAPlaceLiesOnAnother) {
  const Pose2 T_world_other(0.8, -0.6, 0.25);
  const MapMatch match = match_maps(map_of(furnished_room(), Pose2(), 1),
                                    map_of(furnished_room(), T_world_other, 2), Pose2());
  const Pose2& found = match.T_reference_other.mean;
  EXPECT_NEAR(found.x(), T_world_other.x(), 0.03);
  EXPECT_NEAR(found.y(), T_world_other.y(), 0.03);
  EXPECT_NEAR(found.theta(), T_world_other.theta(), 0.01);
  EXPECT_TRUE(is_positive_definite(match.T_reference_other.covariance));
  EXPECT_GT(match.occupied_agreement, 0.9);
  EXPECT_LT(match.free_conflict, 0.01);
  EXPECT_GT(match.overlap_share, 0.9);
  EXPECT_GT(match.log_likelihood_ratio, 5.0);
}

TEST(MapMatching, TellsDifferentPlacesApart) {
  const MapMatch match =
      match_maps(map_of(furnished_room(), Pose2(), 1), map_of(another_room(), Pose2(), 2), Pose2());
  EXPECT_LT(match.occupied_agreement, 0.75);
  EXPECT_LT(match.log_likelihood_ratio, -2.0);
}

TEST(MapMatching, HasNoOpinionWithoutCommonGround) {
  const OccupancyGrid room = map_of(furnished_room(), Pose2(), 1);
  const MapMatch apart = match_maps(room, room, Pose2(100.0, 0.0, 0.0));
  EXPECT_EQ(apart.overlap_share, 0.0);
  EXPECT_EQ(apart.log_likelihood_ratio, 0.0);
  const MapMatch empty = match_maps(room, OccupancyGrid(room.geometry()), Pose2());
  EXPECT_EQ(empty.log_likelihood_ratio, 0.0);
  EXPECT_TRUE(is_positive_definite(empty.T_reference_other.covariance));
}

TEST(MapMatching, IsAsUncertainAsTheWallsLeaveIt) {
  const std::vector<Wall> corridor = test::endless_corridor();
  const MapMatch match =
      match_maps(map_of(corridor, Pose2(), 1), map_of(corridor, Pose2(), 2), Pose2());
  const Matrix3d& covariance = match.T_reference_other.covariance;
  EXPECT_GT(covariance(0, 0), 25.0 * covariance(1, 1));
}

TEST(MapMatching, OptionsAreChecked) {
  EXPECT_TRUE(validate(MapMatchOptions{}).ok());
  MapMatchOptions options;
  options.hit_sigma_m = 0.0;
  EXPECT_FALSE(validate(options).ok());
}

}  // namespace
}  // namespace cairn
