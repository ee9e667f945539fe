#include "service/best_map.hpp"

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using test::corner_at;
using test::scan_at;
using ::testing::SizeIs;

TEST(DepartureGateway, IsTheOneThatWasCrossed) {
  EXPECT_EQ(departure_gateway(corner_at({0, 0}), corner_at({9, 0})), 1);
}

TEST(DepartureGateway, IsTheOneThatPointsToTheNextPlaceWhereNoneWasCrossed) {
  PlaceVisit visit = corner_at({0, 0});
  visit.departure_gateway = -1;
  EXPECT_EQ(departure_gateway(visit, corner_at({9, 0})), 0);
  EXPECT_EQ(departure_gateway(visit, corner_at({0, -9})), 1);
}

TEST(PosesBetween, FollowOdometryAndEndAtTheScans) {
  std::vector<PerceivedScan> scans = {scan_at(0, Pose2(), Pose2()),
                                      scan_at(1, Pose2(1.1, 0, 0), Pose2(1.1, 0, 0))};
  scans[1].between = {{time_of_utime(1'050'000), Pose2(0.5, 0, 0)},
                      {scans[1].fix.time, Pose2(1.0, 0, 0)}};
  const std::vector<TimedPose> poses =
      with_poses_between(scans, {{scans[0].scan, Pose2()}, {scans[1].scan, Pose2(1.1, 0, 0)}});
  ASSERT_THAT(poses, SizeIs(3));
  EXPECT_EQ(poses[1].time, time_of_utime(1'050'000));
  EXPECT_NEAR(poses[1].T_global_robot.x(), 0.55,
              1e-9);  // Half of the motion, half of what it lacked.
  EXPECT_NEAR(poses[2].T_global_robot.x(), 1.1, 1e-9);
}

TEST(Aligned, FindsTheTransformThatPointsWereMovedBy) {
  const Pose2 T_a_b(1.0, -2.0, 0.7);
  std::vector<Vector2d> in_a;
  const std::vector<Vector2d> in_b = {{0, 0}, {2, 0}, {1, 3}};
  for (const Vector2d& p : in_b) {
    in_a.push_back(T_a_b * p);
  }
  const Pose2 found = aligned(in_a, in_b, 0.0);
  EXPECT_NEAR(found.x(), 1.0, 1e-9);
  EXPECT_NEAR(found.y(), -2.0, 1e-9);
  EXPECT_NEAR(found.theta(), 0.7, 1e-9);
}

TEST(Aligned, TakesTheGivenHeadingWhereOnePointTellsNone) {
  EXPECT_NEAR(aligned({{1.0, 1.0}}, {{0.0, 0.0}}, 0.3).theta(), 0.3, 1e-12);
}

}  // namespace
}  // namespace cairn
