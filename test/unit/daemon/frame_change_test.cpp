#include "transport/frame_change.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;

constexpr Sender kSender{11, 22};

/// The robot at the end of its way, and places by the scans with which they were first seen.
MapState picture(std::int64_t revision,
                 const std::vector<std::pair<std::size_t, Pose2>>& places,
                 const Pose2& T_global_lpm = {}) {
  MapState state;
  state.topology_revision = revision;
  state.trajectory = {{std::make_shared<const LaserScan>(), T_global_lpm * Pose2(5.0, 0.0, 0.0)}};
  state.T_global_lpm = T_global_lpm;
  for (const auto& [anchor, pose] : places) {
    MappedPlace place;
    place.id = static_cast<int>(state.places.size());
    place.anchor_scan = anchor;
    place.T_global_place.mean = pose;
    state.places.push_back(place);
  }
  return state;
}

TEST(FrameChange, AMapThatStaysIsNone) {
  const MapState older = picture(1, {{0, Pose2()}, {9, Pose2(4, 0, 0)}});
  const MapState newer = picture(2, {{0, Pose2()}, {9, Pose2(4.005, 0, 0)}, {20, Pose2(8, 8, 1)}});
  EXPECT_FALSE(to_frame_change(older, newer, kSender));
  EXPECT_FALSE(to_frame_change(MapState(), newer, kSender));
}

TEST(FrameChange, MovesCoordinatesAtAPlaceAlongWithIt) {
  const MapState older = picture(1, {{0, Pose2()}, {9, Pose2(4, 0, 0)}});
  const MapState newer = picture(2, {{0, Pose2()}, {9, Pose2(4, 1, 0.5)}});
  const auto change = to_frame_change(older, newer, kSender);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->older_revision, 1);
  EXPECT_EQ(change->newer_revision, 2);
  EXPECT_EQ(change->boot_id, 11);
  EXPECT_EQ(change->map_id, 22);
  EXPECT_THAT(change->place_id, ElementsAre(1));
  EXPECT_NEAR(change->largest_move_m, 1.0, 1e-12);
  const Pose2 T_newer_older(change->dx_m[0], change->dy_m[0], change->dtheta_rad[0]);
  const Vector2d beside = Vector2d(4, 0) + Vector2d(0.3, 0.4);  // In the older map.
  const Vector2d expected = Pose2(4, 1, 0.5) * Vector2d(0.3, 0.4);
  EXPECT_NEAR((T_newer_older * beside - expected).norm(), 0.0, 1e-12);
}

TEST(FrameChange, PlacesAreTheSameWhateverTheirNumbers) {
  const MapState older = picture(1, {{0, Pose2()}, {9, Pose2(4, 0, 0)}, {30, Pose2(0, 7, 0)}});
  const MapState newer = picture(2, {{0, Pose2()}, {30, Pose2(0, 7.5, 0)}});
  const auto change = to_frame_change(older, newer, kSender);
  ASSERT_TRUE(change);
  EXPECT_THAT(change->place_id, ElementsAre(1));
  EXPECT_NEAR(change->dy_m[0], 0.5, 1e-12);
}

TEST(FrameChange, TheRobotsOwnIsThatOfTheLocalMap) {
  const MapState older = picture(4, {{0, Pose2()}}, Pose2(1, 0, 0));
  const MapState newer = picture(4, {{0, Pose2()}}, Pose2(1, 0, 0.1));
  const auto change = to_frame_change(older, newer, kSender);
  ASSERT_TRUE(change);
  const Pose2 T_newer_older(change->robot_dx_m, change->robot_dy_m, change->robot_dtheta_rad);
  EXPECT_NEAR((T_newer_older * older.trajectory.back().T_global_robot.translation() -
               newer.trajectory.back().T_global_robot.translation())
                  .norm(),
              0.0, 1e-12);
  EXPECT_THAT(change->place_id, ElementsAre());
}

}  // namespace
}  // namespace cairn
