#include "lpm/global_localiser.hpp"

#include <functional>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "lpm/scrolling_map.hpp"
#include "lpm/surface_points.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::SimulatedLaser;
using test::Wall;

/// A room, a corridor with niches that are all alike, and another room at its end.
std::vector<Wall> building() {
  std::vector<Wall> walls;
  const auto line = [&walls](std::vector<Vector2d> corners) {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      walls.push_back({corners[i - 1], corners[i]});
    }
  };
  line({{-8, -1}, {8, -1}, {8, -4}, {13, -4}, {13, 3}, {8, 3}, {8, 1}});
  for (const double x : {-6.0, -2.0, 2.0, 6.0}) {
    line({{x, 1}, {x, 1.6}, {x + 1, 1.6}, {x + 1, 1}});
    line({{x - 3, 1}, {x, 1}});
  }
  line({{7, 1}, {8, 1}});
  line({{-9, 1}, {-8, 1}, {-8, 5}, {-14, 5}, {-14, -3}, {-8, -3}, {-8, -1}});
  test::add_box({-11, 2}, {-10, 3}, &walls);
  test::add_box({10, -2.5}, {11.5, -2}, &walls);
  return walls;
}

OccupancyGrid map_of(const std::vector<Wall>& walls, double from_m, double to_m) {
  ScrollingMapOptions options;
  options.cell_m = 0.1;
  options.window_m = 80.0;
  ScrollingMap map(options);
  SimulatedLaser laser(walls, 77);
  for (double x = from_m; x <= to_m; x += 0.5) {
    for (int i = 0; i < 4; ++i) {
      const Pose2 pose(x, 0.0, 0.5 * kPi * i);
      map.insert(laser.scan(pose, 0.1), pose, 0.0);
    }
  }
  return map.grid();
}

/// Drives a way and returns the last fix; calls back after each.
GlobalFix drive(GlobalLocaliser* localiser,
                const std::vector<Wall>& walls,
                int steps,
                const std::function<Pose2(int)>& way,
                const std::function<void(const GlobalFix&, const Pose2&)>& look = {},
                std::int64_t lookups = std::numeric_limits<std::int64_t>::max()) {
  SimulatedLaser laser(walls, 5);
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0.0, 0.01);
  GlobalFix fix;
  for (int i = 0; i < steps; ++i) {
    GaussianPose step;
    step.covariance.diagonal() << 4e-4, 4e-4, 1e-4;
    if (i > 0) {
      const Pose2 true_step = way(i - 1).inverse() * way(i);
      step.mean = Pose2(true_step.x() + noise(random), true_step.y(),
                        true_step.theta() + 0.5 * noise(random));
    }
    LaserScan scan = laser.scan(way(i), 0.2 * i);
    scan.max_range_m = 6.0;
    fix = localiser->absorb(surface_points_of(scan, 0.05, 6.0), step, lookups);
    if (look) {
      look(fix, way(i));
    }
  }
  return fix;
}

GlobalLocaliserOptions quick() {
  GlobalLocaliserOptions options;
  options.key_scans = 6;
  options.accept_travel_m = 2.0;
  return options;
}

Pose2 along_the_corridor(int step) {
  return {-7.0 + 0.1 * step, 0.0, 0.0};
}

TEST(GlobalLocaliser, AcceptsTheRightPoseAndNeverAWrongOne) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  int accepted = 0;
  const GlobalFix last =
      drive(&localiser, building(), 160, along_the_corridor,
            [&](const GlobalFix& fix, const Pose2& truth) {
              accepted += fix.state == Localisation::kAccepted;
              ASSERT_NE(fix.state, Localisation::kLost);
              if (fix.T_map_robot) {
                const Pose2& found = fix.T_map_robot->mean;
                EXPECT_LT((found.translation() - truth.translation()).norm(), 0.3);
                EXPECT_LT(std::abs(turn_between(found.theta(), truth.theta())), 0.1);
                EXPECT_TRUE(is_positive_definite(fix.T_map_robot->covariance));
              }
            });
  EXPECT_EQ(accepted, 1);
  EXPECT_EQ(last.state, Localisation::kTracking);
}

TEST(GlobalLocaliser, AcceptsTheRightPoseWhenItMaySearchOnlyALittleWithEachScan) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  int accepted = 0;
  drive(
      &localiser, building(), 160, along_the_corridor,
      [&](const GlobalFix& fix, const Pose2& truth) {
        accepted += fix.state == Localisation::kAccepted;
        if (fix.T_map_robot) {
          EXPECT_LT((fix.T_map_robot->mean.translation() - truth.translation()).norm(), 0.3);
        }
      },
      1'000'000);
  EXPECT_EQ(accepted, 1);
  EXPECT_LT(localiser.searches(), 30) << "not one for each key scan";
}

TEST(GlobalLocaliser, AcceptsNothingWhileTheRobotStands) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  const GlobalFix last =
      drive(&localiser, building(), 40, [](int) { return Pose2(-10.0, 0.0, 0.0); });
  EXPECT_EQ(last.state, Localisation::kSearching);
  EXPECT_FALSE(last.T_map_robot.has_value());
}

TEST(GlobalLocaliser, AcceptsNothingWhereTwoPlacesAreAlike) {
  std::vector<Wall> hall;  // looks the same when turned by half a turn
  test::add_box({-6.0, -3.0}, {6.0, 3.0}, &hall);
  const GlobalSearch search(map_of(hall, -5.0, 5.0));
  GlobalLocaliser localiser(search, quick());
  drive(
      &localiser, hall, 80, [](int step) { return Pose2(-4.0 + 0.1 * step, 0.5, 0.0); },
      [](const GlobalFix& fix, const Pose2&) { EXPECT_EQ(fix.state, Localisation::kSearching); });
}

TEST(GlobalLocaliser, AcceptsNothingInAnotherBuilding) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  std::vector<Wall> other = test::furnished_room();
  drive(
      &localiser, other, 60,
      [](int step) {
        return Pose2(1.5 * std::cos(0.07 * step), 1.5 * std::sin(0.07 * step), 0.07 * step);
      },
      [](const GlobalFix& fix, const Pose2&) { EXPECT_EQ(fix.state, Localisation::kSearching); });
}

TEST(GlobalLocaliser, NoticesThatItWasCarriedAwayAndFindsItselfAgain) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  ASSERT_EQ(drive(&localiser, building(), 150, along_the_corridor).state, Localisation::kTracking);
  bool was_lost = false;
  Pose2 end;
  const GlobalFix last = drive(
      &localiser, building(), 130,
      [](int step) {
        const double angle = 0.06 * step;
        return Pose2(-11.0 + 2.2 * std::cos(angle), -0.4 + 1.4 * std::sin(angle), angle + 1.5);
      },
      [&](const GlobalFix& fix, const Pose2& truth) {
        was_lost = was_lost || fix.state == Localisation::kLost;
        end = truth;
      });
  EXPECT_TRUE(was_lost);
  ASSERT_TRUE(last.T_map_robot.has_value()) << to_string(last.state);
  EXPECT_LT((last.T_map_robot->mean.translation() - end.translation()).norm(), 0.3);
}

TEST(GlobalLocaliser, SurvivesScansWithoutReturns) {
  const GlobalSearch search(map_of(building(), -13.0, 12.0));
  GlobalLocaliser localiser(search, quick());
  for (int i = 0; i < 30; ++i) {
    const GlobalFix fix = localiser.absorb({}, {Pose2(0.3, 0.0, 0.0), 1e-4 * Matrix3d::Identity()});
    EXPECT_EQ(fix.state, Localisation::kSearching);
  }
}

}  // namespace
}  // namespace cairn
