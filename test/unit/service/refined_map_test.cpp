#include "service/refined_map.hpp"

#include <gmock/gmock.h>

#include "unit/refinement/two_laps.hpp"

namespace cairn {
namespace {

using test::TwoLaps;
using ::testing::SizeIs;

TrajectoryRefinementOptions for_a_small_room() {
  TrajectoryRefinementOptions options;
  options.matching.apart_m = 8.0;
  return options;
}

/// Two laps as a picture of the map, with one pose between each two scans and one place.
std::shared_ptr<MapState> picture_of(const TwoLaps& laps) {
  auto state = std::make_shared<MapState>();
  const auto scan = std::make_shared<const LaserScan>();
  for (std::size_t i = 0; i < laps.believed.size(); ++i) {
    const auto utime = static_cast<std::int64_t>(i) * 100'000;
    if (i > 0) {
      const Pose2 midway = laps.believed[i - 1] * Pose2(0.1, 0.0, 0.05);
      state->poses.push_back({time_of_utime(utime - 50'000), midway, false});
    }
    state->poses.push_back({time_of_utime(utime), laps.believed[i]});
    state->trajectory.push_back({scan, laps.believed[i]});
  }
  state->key_scans = laps.keys;
  MappedPlace place;
  place.anchor_scan = laps.believed.size() - 10;
  place.T_global_place.mean = laps.believed[place.anchor_scan];
  state->places.push_back(place);
  state->T_global_lpm = Pose2(1.0, 2.0, 3.0);
  return state;
}

TEST(MapRefiner, PlacesAndPosesBetweenScansFollowTheScans) {
  const TwoLaps laps;
  MapRefiner refiner(for_a_small_room());
  const std::shared_ptr<const MapState> refined = refiner.refined(picture_of(laps));
  ASSERT_THAT(refined->poses, SizeIs(2 * laps.believed.size() - 1));
  std::vector<Pose2> poses;
  for (const PosedScan& posed : refined->trajectory) {
    poses.push_back(posed.T_global_robot);
  }
  EXPECT_LT(laps.laps_apart_m(poses), 0.5 * laps.laps_apart_m(laps.believed));
  const MappedPlace& place = refined->places.front();
  EXPECT_NEAR(
      (place.T_global_place.mean.translation() - poses[place.anchor_scan].translation()).norm(),
      0.0, 1e-9);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_EQ(refined->poses[2 * i].T_global_robot, poses[i]);
    const Vector2d midway = (poses[i - 1] * Pose2(0.1, 0.0, 0.05)).translation();
    EXPECT_LT((refined->poses[2 * i - 1].T_global_robot.translation() - midway).norm(), 0.01);
  }
}

TEST(MapRefiner, TheLocalMapFollowsTheLastScan) {
  const TwoLaps laps;
  const std::shared_ptr<const MapState> before = picture_of(laps);
  MapRefiner refiner(for_a_small_room());
  const std::shared_ptr<const MapState> after = refiner.refined(before);
  const Pose2 T_lpm_robot =
      before->T_global_lpm.inverse() * before->trajectory.back().T_global_robot;
  const Pose2 expected = after->trajectory.back().T_global_robot;
  const Pose2 found = after->T_global_lpm * T_lpm_robot;
  EXPECT_NEAR((found.translation() - expected.translation()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(turn_between(found.theta(), expected.theta()), 0.0, 1e-9);
}

TEST(MapRefiner, AnEmptyMapStaysEmpty) {
  MapRefiner refiner;
  EXPECT_TRUE(refiner.refined(std::make_shared<const MapState>())->trajectory.empty());
}

TimedPose pose_at(std::int64_t utime, double x_m, bool is_of_scan) {
  return {time_of_utime(utime), Pose2(x_m, 0.0, 0.0), is_of_scan};
}

TEST(OnePoseForEachTime, IsTheMeanOfTheScansOfThatTime) {
  const std::vector<TimedPose> unique = one_pose_for_each_time(
      {pose_at(1, 1.0, false), pose_at(2, 2.0, false), pose_at(2, 3.0, false),
       pose_at(2, 4.0, true), pose_at(2, 5.0, true), pose_at(2, 9.0, false), pose_at(3, 7.0, true),
       pose_at(1, 2.0, false), pose_at(3, 8.0, false)});
  ASSERT_THAT(unique, SizeIs(3));
  EXPECT_DOUBLE_EQ(unique[0].T_global_robot.x(), 1.5);
  EXPECT_FALSE(unique[0].is_of_scan);
  EXPECT_DOUBLE_EQ(unique[1].T_global_robot.x(), 4.5);
  EXPECT_TRUE(unique[1].is_of_scan);
  EXPECT_EQ(unique[2].T_global_robot, Pose2(7.0, 0.0, 0.0));
}

TEST(OnePoseForEachTime, HeadingsAreMeantAroundTheCircle) {
  TimedPose a = pose_at(1, 0.0, true);
  TimedPose b = pose_at(1, 0.0, true);
  a.T_global_robot = Pose2(0, 0, kPi - 0.1);
  b.T_global_robot = Pose2(0, 0, -kPi + 0.3);
  const std::vector<TimedPose> unique = one_pose_for_each_time({a, b});
  ASSERT_THAT(unique, SizeIs(1));
  EXPECT_NEAR(turn_between(unique[0].T_global_robot.theta(), -kPi + 0.1), 0.0, 1e-9);
}

TEST(OnePoseForEachTime, PosesOfTheirOwnTimeStayAsTheyAre) {
  const std::vector<TimedPose> poses = {pose_at(5, 1.0, true), pose_at(3, 2.0, false),
                                        pose_at(4, 3.0, true)};
  const std::vector<TimedPose> unique = one_pose_for_each_time(poses);
  ASSERT_THAT(unique, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(unique[i].time, poses[i].time);
    EXPECT_EQ(unique[i].T_global_robot, poses[i].T_global_robot);
  }
}

}  // namespace
}  // namespace cairn
