// Lasers that take a while for a sweep, on robots that move meanwhile.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::Wall;

constexpr double kSweep_s = 0.14;
constexpr double kScanPeriod_s = 0.15;

std::vector<Wall> room() {
  std::vector<Wall> walls;
  test::add_box({-2.0, -1.5}, {2.0, 1.5}, &walls);
  return walls;
}

/// Turns by up to 1.6 rad/s while it goes, from rest.
Pose2 turning_to_and_fro(double time_s) {
  return {0.3 - 0.3 * std::cos(0.5 * time_s), 0.0, 2.0 - 2.0 * std::cos(0.8 * time_s)};
}

/// One beam after the other, over 180 degrees, with 1 cm of noise.
LaserScan swept(const std::vector<Wall>& walls, double time_s, std::mt19937* random) {
  constexpr int kBeams = 181;
  std::normal_distribution<double> noise(0.0, 0.01);
  LaserScan scan;
  scan.time = time_of_utime(static_cast<std::int64_t>(std::llround(time_s * 1e6)));
  scan.max_range_m = 20.0;
  scan.sweep_duration_s = kSweep_s;
  for (int i = 0; i < kBeams; ++i) {
    const double share = static_cast<double>(i) / (kBeams - 1);
    const double bearing_rad = kPi * (share - 0.5);
    const Pose2 at = turning_to_and_fro(time_s + kSweep_s * share);
    const double range_m = test::range_to(walls, at.translation(), at.theta() + bearing_rad);
    scan.bearings_rad.push_back(static_cast<float>(bearing_rad));
    scan.ranges_m.push_back(static_cast<float>(range_m + noise(*random)));
  }
  return scan;
}

struct Errors {
  double mean_m = 0.0;
  double mean_rad = 0.0;
  double worst_rad = 0.0;
};

Errors drive(bool has_odometry, bool says_sweep) {
  constexpr int kScans = 150;
  const std::vector<Wall> walls = room();
  std::mt19937 random(1);
  LocalMapper mapper;
  Errors errors;
  for (int i = 0; i < kScans; ++i) {
    const double time_s = kScanPeriod_s * i;
    const Pose2 T_start_robot = turning_to_and_fro(0.0).inverse() * turning_to_and_fro(time_s);
    JoinedScan joined{swept(walls, time_s, &random), std::nullopt};
    joined.scan.sweep_duration_s = says_sweep ? kSweep_s : 0.0;
    if (has_odometry) {
      joined.T_odom_robot =
          Pose2(T_start_robot.x(), T_start_robot.y(), 1.02 * T_start_robot.theta());
    }
    const LocalFix fix = mapper.absorb(joined);
    const double off_rad = std::abs(turn_between(T_start_robot.theta(), fix.T_lpm_robot.theta()));
    errors.mean_m += (fix.T_lpm_robot.translation() - T_start_robot.translation()).norm() / kScans;
    errors.mean_rad += off_rad / kScans;
    errors.worst_rad = std::max(errors.worst_rad, off_rad);
  }
  return errors;
}

TEST(LocalMapper, OdometryUnbendsSweeps) {
  const Errors unbent = drive(true, true);
  const Errors bent = drive(true, false);
  RecordProperty("unbent", std::to_string(unbent.mean_m) + " m " + std::to_string(unbent.mean_rad));
  RecordProperty("bent", std::to_string(bent.mean_m) + " m " + std::to_string(bent.mean_rad));
  EXPECT_LT(unbent.worst_rad, 0.10);
  EXPECT_LT(unbent.mean_rad, 0.3 * bent.mean_rad);
}

TEST(LocalMapper, WithoutOdometryMatchesUnbendSweeps) {
  const Errors unbent = drive(false, true);
  const Errors bent = drive(false, false);
  RecordProperty("unbent", std::to_string(unbent.mean_m) + " m " + std::to_string(unbent.mean_rad));
  RecordProperty("bent", std::to_string(bent.mean_m) + " m " + std::to_string(bent.mean_rad));
  EXPECT_LT(unbent.worst_rad, 0.10);
  EXPECT_LT(unbent.mean_rad, 0.3 * bent.mean_rad);
}

}  // namespace
}  // namespace cairn
