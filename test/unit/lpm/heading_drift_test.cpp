#include "lpm/heading_drift.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::SimulatedLaser;
using test::Wall;

constexpr double kPlaceSigma_rad = 0.008;

struct Outcome {
  double drift_rms_rad = 0.0;
  double rest_rms_rad = 0.0;  // of the drift, once corrected
  double correction_rms_rad = 0.0;
};

/// Goes so far, with a measurement every 0.2 m whose error is that of its place, 3 m long, and half
/// as much by chance.
Outcome go(double travel_m, double drift_rad2_per_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> unit;
  HeadingDrift heading;
  Outcome outcome;
  double drift_rad = 0.0;
  double place_rad = 0.0;
  const int steps = static_cast<int>(5.0 * travel_m);
  for (int i = 0; i < steps; ++i) {
    drift_rad += std::sqrt(0.2 * drift_rad2_per_m) * unit(random);
    place_rad = i % 15 == 0 ? kPlaceSigma_rad * unit(random) : place_rad;
    heading.absorb(0.2 * i, 0.3 + drift_rad + place_rad + 0.5 * kPlaceSigma_rad * unit(random));
    const double correction_rad = heading.correction_rad();
    outcome.drift_rms_rad += drift_rad * drift_rad / steps;
    outcome.rest_rms_rad += std::pow(drift_rad + correction_rad, 2) / steps;
    outcome.correction_rms_rad += correction_rad * correction_rad / steps;
  }
  outcome.drift_rms_rad = std::sqrt(outcome.drift_rms_rad);
  outcome.rest_rms_rad = std::sqrt(outcome.rest_rms_rad);
  outcome.correction_rms_rad = std::sqrt(outcome.correction_rms_rad);
  return outcome;
}

TEST(HeadingDrift, IsCorrectedWhereItShows) {
  int better = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome outcome = go(600.0, 1e-5, seed);
    better += outcome.rest_rms_rad < 0.6 * outcome.drift_rms_rad ? 1 : 0;
    EXPECT_LT(outcome.rest_rms_rad, 0.04) << seed;
  }
  EXPECT_GE(better, 15);
}

TEST(HeadingDrift, IsHardlyTouchedWhereWallsAreButAskew) {
  double worst_rad = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    worst_rad = std::max(worst_rad, go(600.0, 0.0, seed).correction_rms_rad);
  }
  EXPECT_LT(worst_rad, 1.5 * kPlaceSigma_rad) << "no more than one look at a wall is off";
}

TEST(HeadingDrift, IsNotLookedForOnShortWays) {
  HeadingDrift heading;
  for (int i = 0; i < 500; ++i) {  // 50 m
    heading.absorb(0.1 * i, 0.001 * i);
    EXPECT_EQ(heading.drift_rad2_per_m(), 0.0);
  }
}

TEST(HeadingDrift, SurvivesLongWaysWithoutWalls) {
  HeadingDrift heading;
  double travel_m = 0.0;
  for (int i = 0; i < 2000; ++i) {
    travel_m += i % 100 == 0 ? 1e7 : 0.3;
    heading.absorb(travel_m, i % 7 == 0 ? 0.02 : -0.01);
    ASSERT_TRUE(std::isfinite(heading.correction_rad()));
    ASSERT_LT(std::abs(heading.correction_rad()), 0.03);
  }
}

/// A corridor with a niche every few metres, on either side in turn.
std::vector<Wall> corridor(int niches) {
  std::vector<Wall> walls;
  for (int i = 0; i < niches; ++i) {
    const double x_m = 3.0 * i;
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    walls.push_back({{x_m, side}, {x_m + 2.0, side}});
    walls.push_back({{x_m + 2.0, side}, {x_m + 2.0, 1.8 * side}});
    walls.push_back({{x_m + 2.0, 1.8 * side}, {x_m + 3.0, 1.8 * side}});
    walls.push_back({{x_m + 3.0, 1.8 * side}, {x_m + 3.0, side}});
    walls.push_back({{x_m, -side}, {x_m + 3.0, -side}});
  }
  return walls;
}

struct Headings {
  double of_map_rad = 0.0;      // worst error of the lpm frame
  double of_motions_rad = 0.0;  // worst error of the motions told, one after the other
};

/// Drives along a corridor with so short a memory that the heading of the map drifts.
Headings drive_forgetfully(bool asks_walls, unsigned seed) {
  LpmOptions options;
  options.map.window_m = 8.0;
  options.map.memory_travel_m = 0.5;
  options.insert_every_m = 0.5;
  options.wall_orientation.enabled = asks_walls;
  LocalMapper mapper(options);
  SimulatedLaser laser(corridor(70), seed);
  laser.set_beams(61, kPi);
  std::mt19937 random(seed);
  std::normal_distribution<double> slip(0.0, 0.004);
  Pose2 T_odom_robot;
  Pose2 compounded;
  Headings headings;
  for (int i = 0; i < 900; ++i) {
    const Pose2 truth(1.0 + 0.2 * i, 0.0, 0.0);
    T_odom_robot = T_odom_robot * Pose2(i == 0 ? 0.0 : 0.2, 0.0, slip(random));
    const LocalFix fix = mapper.absorb({laser.scan(truth, 0.2 * i), T_odom_robot});
    compounded = compounded * fix.motion.mean;
    headings.of_map_rad = std::max(headings.of_map_rad, std::abs(fix.T_lpm_robot.theta()));
    headings.of_motions_rad = std::max(headings.of_motions_rad, std::abs(compounded.theta()));
  }
  return headings;
}

TEST(LocalMapper, WallsHoldTheHeadingOfDeadReckoning) {
  double with_walls_rad = 0.0;
  double without_rad = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Headings with = drive_forgetfully(true, seed);
    const Headings without = drive_forgetfully(false, seed);
    EXPECT_EQ(with.of_map_rad, without.of_map_rad) << "the map stays as it was drawn";
    EXPECT_NEAR(without.of_motions_rad, without.of_map_rad, 1e-9);
    with_walls_rad += with.of_motions_rad;
    without_rad += without.of_motions_rad;
  }
  EXPECT_LT(with_walls_rad, 0.8 * without_rad);
}

}  // namespace
}  // namespace cairn
