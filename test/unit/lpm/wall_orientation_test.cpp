#include "lpm/wall_orientation.hpp"

#include <functional>
#include <random>

#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::SimulatedLaser;
using test::Wall;

/// Rooms along a corridor, all at right angles, the whole turned by an angle.
std::vector<Wall> right_angled_building(double turned_rad) {
  std::vector<Wall> walls;
  test::add_box({-12.0, -6.0}, {12.0, 6.0}, &walls);
  for (const double x : {-8.0, -4.0, 0.0, 4.0, 8.0}) {
    walls.push_back({{x, 1.2}, {x, 6.0}});
    walls.push_back({{x - 3.0, 1.2}, {x, 1.2}});
    walls.push_back({{x, -1.2}, {x, -6.0}});
    walls.push_back({{x - 3.0, -1.2}, {x, -1.2}});
  }
  const Pose2 turn(0.0, 0.0, turned_rad);
  for (Wall& wall : walls) {
    wall = {turn * wall.from, turn * wall.to};
  }
  return walls;
}

/// Walls around the middle, `sides` of them: many make it round.
std::vector<Wall> ring(int sides, double radius_m, double turned_rad) {
  std::vector<Wall> walls;
  const auto corner = [&](int i) {
    const double angle = turned_rad + 2.0 * kPi * i / sides;
    return Vector2d(radius_m * std::cos(angle), radius_m * std::sin(angle));
  };
  for (int i = 0; i < sides; ++i) {
    walls.push_back({corner(i), corner(i + 1)});
  }
  return walls;
}

ScanBeams beams_of(const LaserScan& scan) {
  ScanBeams beams;
  beams.take(scan, {}, 20.0);
  return beams;
}

struct Outcome {
  double worst_heading_error_rad = 0.0;  // of the corrected heading, once measured
  double worst_in_sigmas = 0.0;
  int measured = 0;
};

/// Drives a way with a heading that drifts, and takes measurements into it, as a Kalman filter
/// would with the drift it knows of.
Outcome drive(const std::vector<Wall>& walls,
              int steps,
              const std::function<Pose2(int)>& way,
              double drift_rad_per_step) {
  SimulatedLaser laser(walls, 3);
  WallOrientation orientation;
  Outcome outcome;
  double error_rad = 0.0;
  for (int i = 0; i < steps; ++i) {
    error_rad += drift_rad_per_step;
    const Pose2 truth = way(i);
    const Pose2 believed(truth.translation(), truth.theta() + error_rad);
    if (const auto heading = orientation.absorb(beams_of(laser.scan(truth, 0.2 * i)), believed)) {
      const double measured_error_rad = turn_between(truth.theta(), heading->theta_rad);
      outcome.worst_in_sigmas =
          std::max(outcome.worst_in_sigmas, std::abs(measured_error_rad) / heading->sigma_rad);
      error_rad += 0.3 * turn_between(believed.theta(), heading->theta_rad);
      ++outcome.measured;
      outcome.worst_heading_error_rad =
          std::max(outcome.worst_heading_error_rad, std::abs(error_rad));
    }
  }
  return outcome;
}

Pose2 up_and_down(int step, double turned_rad) {
  const double along = 10.0 * std::sin(0.02 * step);
  return Pose2(0.0, 0.0, turned_rad) *
         Pose2(along, 0.3 * std::sin(0.1 * step), 0.5 * std::sin(0.07 * step));
}

Pose2 around(int step) {
  return {2.0 * std::cos(0.05 * step), 2.0 * std::sin(0.05 * step), 0.05 * step + 0.5 * kPi};
}

TEST(WallSegments, AreTheWallsOfTheRoom) {
  std::vector<Wall> walls;
  test::add_box({-2.0, -3.0}, {4.0, 3.0}, &walls);
  WallSegmenter segmenter;
  const std::vector<WallSegment>& segments =
      segmenter.split(beams_of(SimulatedLaser(walls).scan(Pose2(0.0, 0.0, 0.3), 0.0)));
  ASSERT_THAT(segments, testing::SizeIs(testing::AllOf(testing::Ge(3U), testing::Le(4U))));
  for (const WallSegment& segment : segments) {
    EXPECT_NEAR(std::remainder(segment.direction_rad + 0.3, 0.5 * kPi), 0.0, 0.02);
    EXPECT_GT(segment.sigma_rad, 0.0);
    EXPECT_LT(segment.sigma_rad, 0.02);
  }
}

TEST(WallSegments, AreNotInAnEmptyScan) {
  EXPECT_THAT(WallSegmenter().split(beams_of(SimulatedLaser({}).scan(Pose2(), 0.0))),
              testing::IsEmpty());
}

TEST(WallOrientation, SaysNothingInClutter) {
  std::vector<Wall> posts;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-9.0, 9.0);
  while (posts.size() < 400) {
    const Vector2d at(any(random), any(random));
    if (std::abs(at.norm() - 2.0) > 0.4) {  // off the way
      const Vector2d across = Pose2(0.0, 0.0, at.x()) * Vector2d(0.1, 0.0);
      posts.push_back({at - across, at + across});
    }
  }
  EXPECT_EQ(drive(posts, 300, around, 0.0).measured, 0);
}

TEST(WallOrientation, HoldsTheHeadingInARightAngledBuilding) {
  for (const double turned_rad : {0.0, 0.4, -0.7, 0.7854, 2.9}) {
    SCOPED_TRACE(turned_rad);
    const Outcome outcome = drive(
        right_angled_building(turned_rad), 600,
        [&](int step) { return up_and_down(step, turned_rad); }, 0.001);
    EXPECT_GT(outcome.measured, 500);
    EXPECT_LT(outcome.worst_heading_error_rad, 0.05) << "the drift sums up to 0.6 rad";
  }
}

TEST(WallOrientation, MeasuresAsWellAsItSays) {
  const Outcome outcome = drive(
      right_angled_building(0.3), 400, [](int step) { return up_and_down(step, 0.3); }, 0.0);
  EXPECT_GT(outcome.measured, 300);
  EXPECT_LT(outcome.worst_in_sigmas, 4.0);
  EXPECT_LT(outcome.worst_heading_error_rad, 0.02);
}

TEST(WallOrientation, SaysNothingInARoundHall) {
  EXPECT_EQ(drive(ring(90, 6.0, 0.0), 300, around, 0.0).measured, 0);
}

TEST(WallOrientation, SaysNothingWhereWallsMeetAtOtherAngles) {
  for (const int sides : {3, 5, 6, 7, 9}) {
    EXPECT_EQ(drive(ring(sides, 7.0, 0.2), 300, around, 0.0).measured, 0) << sides;
  }
}

TEST(WallOrientation, IsNotHarmedByAnObliqueWall) {
  std::vector<Wall> walls = right_angled_building(0.0);
  walls.push_back({{-12.0, -1.0}, {-10.0, -6.0}});
  walls.push_back({{9.0, 1.2}, {12.0, 4.2}});
  const Outcome outcome = drive(
      walls, 600, [](int step) { return up_and_down(step, 0.0); }, 0.0005);
  EXPECT_GT(outcome.measured, 400);
  EXPECT_LT(outcome.worst_heading_error_rad, 0.04);
}

TEST(WallOrientation, IsNotHarmedByAWingThatIsTurnedSlightly) {
  std::vector<Wall> walls;
  test::add_box({-12.0, -2.0}, {0.0, 2.0}, &walls);
  walls.erase(walls.begin() + 1);  // open to the wing
  std::vector<Wall> wing;
  test::add_box({0.0, -2.0}, {12.0, 2.0}, &wing);
  wing.pop_back();
  const Pose2 turn(0.0, 0.0, 0.1);
  for (const Wall& wall : wing) {
    walls.push_back({turn * wall.from, turn * wall.to});
  }
  const Outcome outcome = drive(
      walls, 600, [](int step) { return up_and_down(step, 0.0); }, 0.0);
  EXPECT_LT(outcome.worst_heading_error_rad, 0.05);
}

TEST(WallOrientation, SaysNothingBeforeItHasSeenEnough) {
  WallOrientation orientation;
  SimulatedLaser laser(right_angled_building(0.0));
  for (int i = 0; i < 50; ++i) {  // standing
    EXPECT_FALSE(orientation.absorb(beams_of(laser.scan(Pose2(), 0.1 * i)), Pose2()).has_value());
  }
  EXPECT_FALSE(orientation.direction().has_value());
}

TEST(WallOrientation, IsSilentWithAHeadingThatIsFarOff) {
  WallOrientation orientation;
  SimulatedLaser laser(right_angled_building(0.0));
  for (int i = 0; i < 300; ++i) {
    const Pose2 pose = up_and_down(i, 0.0);
    (void)orientation.absorb(beams_of(laser.scan(pose, 0.1 * i)), pose);
  }
  ASSERT_TRUE(orientation.direction().has_value());
  EXPECT_GT(orientation.direction()->aligned_share, 0.9);
  EXPECT_NEAR(orientation.direction()->direction_rad, 0.0, 0.01);
  const Pose2 truth = up_and_down(10, 0.0);
  const Pose2 wrong(truth.translation(), truth.theta() + 0.4);
  EXPECT_FALSE(orientation.absorb(beams_of(laser.scan(truth, 99.0)), wrong).has_value());
}

}  // namespace
}  // namespace cairn
