// Two lasers of half a turn each, front and rear, are one of a whole turn.

#include <cmath>

#include <gmock/gmock.h>

#include "simulated_drive.hpp"

namespace cairn {
namespace {

using test::Readings;

const Pose2 kFront(0.2, 0.0, 0.0);
const Pose2 kRear(-0.3, 0.1, kPi);

double mean_error_m(const std::vector<Pose2>& mounting) {
  test::SimulatedDrive drive;
  drive.mount_lasers(mounting);
  double sum_m = 0.0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    drive.go(1);
    sum_m += drive.error_m();
  }
  EXPECT_LT(drive.share_of_stray_walls(), 0.01);
  EXPECT_EQ(drive.health().times_lost, 0);
  EXPECT_EQ(drive.health().state, LocalisationState::kTracking);
  return sum_m / kSteps;
}

/// Occupied cells in the half before or behind the robot where it started.
int walls_seen(const test::SimulatedDrive& drive, bool ahead) {
  const OccupancyGrid& map = drive.service().local_map();
  int seen = 0;
  for (int y = 0; y < map.geometry().height; ++y) {
    for (int x = 0; x < map.geometry().width; ++x) {
      const double along_m = map.geometry().center_of({x, y}).x();
      const bool is_there = ahead ? along_m > 0.5 : along_m < -0.5;
      seen += is_there && map.state({x, y}) == CellState::kOccupied ? 1 : 0;
    }
  }
  return seen;
}

TEST(SeveralLasers, MakeTheTrajectoryNoWorse) {
  const double one_m = mean_error_m({kFront});
  const double two_m = mean_error_m({kFront, kRear});
  EXPECT_LE(two_m, 1.1 * one_m + 0.002) << "one: " << one_m;
}

TEST(SeveralLasers, ShowBothFieldsOfViewInTheMapAtOnce) {
  test::SimulatedDrive one;
  one.mount_lasers({kFront});
  one.stand(3);
  EXPECT_GT(walls_seen(one, true), 100);
  EXPECT_LT(walls_seen(one, false), 10);
  test::SimulatedDrive two;
  two.mount_lasers({kFront, kRear});
  two.stand(3);
  EXPECT_GT(walls_seen(two, true), 100);
  EXPECT_GT(walls_seen(two, false), 100);
  EXPECT_LT(two.share_of_stray_walls(), 0.01);
}

TEST(SeveralLasers, DoNotWaitForEachOther) {
  test::SimulatedDrive drive;
  drive.mount_lasers({kFront, kRear});
  for (std::size_t i = 1; i <= 50; ++i) {
    drive.go(1);
    EXPECT_EQ(drive.perceived().size(), 2 * i);
  }
  EXPECT_EQ(drive.service().joiner_counters().out_of_order, 0U);
}

TEST(SeveralLasers, MayLagBehindEachOther) {
  test::SimulatedDrive drive;
  drive.mount_lasers({kFront, kRear});
  std::optional<LaserScan> late;
  drive.go(200, [&late](Readings* readings) {  // the rear scan comes a tenth of a second late
    LaserScan now = std::move(readings->scans.back());
    readings->scans.pop_back();
    if (late) {
      readings->scans.push_back(*std::move(late));
    }
    late = std::move(now);
  });
  drive.finish();
  EXPECT_EQ(drive.perceived().size(), 399U);
  EXPECT_EQ(drive.service().joiner_counters().out_of_order, 0U);
  EXPECT_EQ(drive.health().times_lost, 0);
  EXPECT_LT(drive.share_of_stray_walls(), 0.01);
}

TEST(SeveralLasers, DoWithoutOdometry) {
  test::SimulatedDrive drive;
  drive.mount_lasers({kFront, kRear});
  drive.go(200, [](Readings* readings) { readings->odometry.reset(); });
  drive.finish();
  EXPECT_LT(drive.error_m(), 0.15);
  EXPECT_LT(drive.share_of_stray_walls(), 0.02);
}

}  // namespace
}  // namespace cairn
