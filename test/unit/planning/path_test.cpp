#include "planning/path.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::grid_of;
using ::testing::HasSubstr;

constexpr double kCell_m = 0.1;

/// Two rooms joined by a near door (below) and a far door (above).
OccupancyGrid two_rooms() {
  return grid_of({"#########################",  //
                  "#...........#...........#",  //
                  "#...........#...........#",  //
                  "#.......................#",  //
                  "#.......................#",  //
                  "#.......................#",  //
                  "#...........#...........#",  //
                  "#...........#...........#",  //
                  "#...........#...........#",  //
                  "#...........#...........#",  //
                  "#.......................#",  //
                  "#.......................#",  //
                  "#.......................#",  //
                  "#...........#..??.......#",  //
                  "#########################"},
                 kCell_m);
}

PathOptions small_robot() {
  PathOptions options;
  options.search.robot_radius_m = 0.1;
  options.search.comfort_clearance_m = 0.2;
  options.corridor_m = 0.4;
  options.waypoint_spacing_m = 0.25;
  options.start_tolerance_m = 0.15;
  return options;
}

const Vector2d kLeft(0.35, 0.35);
const Vector2d kRight(2.15, 0.35);

TEST(MetricPath, LeadsFromStartToGoalInShortSteps) {
  PathPlanner planner(two_rooms(), small_robot());
  const Result<MetricPath> path = planner.find_path(kLeft, {kRight, 1.0});
  ASSERT_TRUE(path) << path.error().message;
  const std::vector<Pose2>& waypoints = path->T_global_waypoint;
  EXPECT_EQ(waypoints.front().translation(), kLeft);
  EXPECT_EQ(waypoints.back(), Pose2(kRight, 1.0));
  double length_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vector2d step = waypoints[i].translation() - waypoints[i - 1].translation();
    EXPECT_LE(step.norm(), 0.25 + 1e-9);
    EXPECT_NEAR(waypoints[i - 1].theta(), std::atan2(step.y(), step.x()), 1e-9);
    length_m += step.norm();
  }
  EXPECT_NEAR(path->length_m, length_m, 1e-9);
  EXPECT_LT(path->length_m, 2.0);
  EXPECT_GE(path->least_clearance_m, 0.1);
  EXPECT_FALSE(path->left_corridor);
}

TEST(MetricPath, AcrossOpenSpaceIsOneLine) {
  PathOptions options = small_robot();
  options.search.comfort_clearance_m = 0.1;
  PathPlanner planner(two_rooms(), options);
  const Vector2d goal(1.0, 0.95);
  const Result<MetricPath> path = planner.find_path(kLeft, {goal, {}});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->length_m, (goal - kLeft).norm(), 0.01);
}

TEST(MetricPath, FollowsTheCorridorOfItsRoute) {
  PathPlanner planner(two_rooms(), small_robot());
  const std::vector<Vector2d> by_the_far_door{{0.5, 1.05}, {1.25, 1.05}, {2.0, 1.05}};
  const Result<MetricPath> path = planner.find_path(kLeft, {kRight, {}}, by_the_far_door);
  ASSERT_TRUE(path);
  EXPECT_FALSE(path->left_corridor);
  double highest_m = 0.0;
  for (const Pose2& waypoint : path->T_global_waypoint) {
    highest_m = std::max(highest_m, waypoint.y());
  }
  EXPECT_GT(highest_m, 0.95);
}

TEST(MetricPath, LeavesTheCorridorWhereItIsBlocked) {
  PathPlanner planner(two_rooms(), small_robot());
  const std::vector<Vector2d> through_the_wall{{1.25, 0.7}};
  PathOptions narrow = small_robot();
  narrow.corridor_m = 0.1;
  PathPlanner strict(two_rooms(), narrow);
  const Result<MetricPath> path =
      strict.find_path({0.35, 0.7}, {{2.15, 0.7}, {}}, through_the_wall);
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_TRUE(path->left_corridor);
}

TEST(MetricPath, SaysWhyAnEndWillNotDo) {
  PathPlanner planner(two_rooms(), small_robot());
  const auto reason_of = [&](double x_m, double y_m) {
    const Result<MetricPath> path = planner.find_path(kLeft, {{x_m, y_m}, {}});
    EXPECT_FALSE(path);
    EXPECT_EQ(path.error().code, ErrorCode::kInvalidValue);
    return path ? "" : path.error().message;
  };
  EXPECT_THAT(reason_of(1.25, 0.65), HasSubstr("the goal (1.25, 0.65) m lies in a wall"));
  EXPECT_THAT(reason_of(-3.0, 0.5), HasSubstr("off the map"));
  EXPECT_THAT(reason_of(NAN, 0.5), HasSubstr("within 1e6 m"));
  EXPECT_THAT(reason_of(1.65, 0.15), HasSubstr("unknown space"));
  PathOptions wide = small_robot();
  wide.search.robot_radius_m = 0.25;
  PathPlanner wide_planner(two_rooms(), wide);
  const Result<MetricPath> tight = wide_planner.find_path({0.6, 0.6}, {{0.15, 0.65}, {}});
  ASSERT_FALSE(tight);
  EXPECT_THAT(tight.error().message,
              HasSubstr("lies 0.10 m from a wall, the robot's radius is 0.25 m"));
}

TEST(MetricPath, SaysWhenNoWayLeadsThere) {
  PathOptions wide = small_robot();
  wide.search.robot_radius_m = 0.25;
  PathPlanner planner(two_rooms(), wide);
  const Result<MetricPath> path = planner.find_path({0.6, 0.6}, {{1.9, 0.6}, {}});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(path.error().message, HasSubstr("no way from (0.60, 0.60) m to (1.90, 0.60) m"));
}

TEST(MetricPath, ARobotThatTouchesAWallMayLeaveIt) {
  PathPlanner planner(two_rooms(), small_robot());
  const Vector2d in_the_wall(0.05, 0.35);
  const Result<MetricPath> path = planner.find_path(in_the_wall, {kRight, {}});
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_EQ(path->T_global_waypoint.front().translation(), in_the_wall);
}

TEST(MetricPath, AGoalInAWallMayBeMovedWhereAllowed) {
  PathOptions options = small_robot();
  options.goal_tolerance_m = 0.2;
  PathPlanner planner(two_rooms(), options);
  const Result<MetricPath> path = planner.find_path(kLeft, {{1.25, 0.65}, {}});
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_NEAR((path->T_global_waypoint.back().translation() - Vector2d(1.25, 0.65)).norm(), 0.0,
              0.21);
}

TEST(MetricPath, ToWhereTheRobotIsTurnsOnTheSpot) {
  PathPlanner planner(two_rooms(), small_robot());
  const Result<MetricPath> path = planner.find_path(kLeft, {kLeft, 2.0});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->length_m, 0.0);
  EXPECT_EQ(path->T_global_waypoint.back(), Pose2(kLeft, 2.0));
}

TEST(MetricPath, IsTheSameEveryTime) {
  PathPlanner planner(two_rooms(), small_robot());
  const Result<MetricPath> first = planner.find_path(kLeft, {kRight, {}});
  static_cast<void>(planner.find_path(kRight, {kLeft, {}}, {{1.0, 1.0}}));
  const Result<MetricPath> second = planner.find_path(kLeft, {kRight, {}});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_global_waypoint, second->T_global_waypoint);
}

}  // namespace
}  // namespace cairn
