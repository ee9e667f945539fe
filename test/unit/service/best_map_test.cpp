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

// Round a triangle of corners, and then to a fourth place where the second one should be.
TEST(MappedSegments, ATravelAgainstTheMapIsBroken) {
  Experience experience;
  std::vector<TravelConstraint> constraints(4);
  PlaceLayout layout;
  for (int i = 0; i < 5; ++i) {
    const Vector2d at(i == 3 ? 0.0 : 10.0 * i, 0.0);
    experience.add(scan_at(i, Pose2(at, 0.0), Pose2(5.0, 0.0, 0.0)));
    experience.add(Visit{corner_at(at), static_cast<std::size_t>(i)});
    layout.T_global_place.emplace_back(at, 0.0);
  }
  const auto stars = std::make_shared<StarCatalogue>();
  const StarId corner = stars->add(corner_at({0, 0}).neighbourhood.star);
  TopologicalMap map(stars, {corner, 0, VisitId{0}});
  map.add_place({PlaceId{0}, 1}, {corner, 0, VisitId{1}});
  map.add_place({PlaceId{1}, 1}, {corner, 0, VisitId{2}});
  map.close({PlaceId{2}, 1}, {PlaceId{0}, 0}, {corner, 0, VisitId{3}});
  map.add_contradicting_place({PlaceId{0}, 1}, {corner, 0, VisitId{4}});

  const std::vector<MappedSegment> segments = mapped_segments(map, experience, layout, constraints);

  ASSERT_THAT(segments, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(segments[i].is_broken, i == 3) << i;
  }
  EXPECT_EQ(segments[3].to_place, 3);
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
