#include "lpm/local_mapper.hpp"

#include <functional>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::endless_corridor;
using test::furnished_room;
using test::SimulatedLaser;

constexpr double kScanPeriod_s = 0.2;

Pose2 on_a_circle(int step) {
  const double angle = 0.05 * step;
  return {1.5 * std::cos(angle), 1.5 * std::sin(angle), angle + kPi / 2.0};
}

double distance_m(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

/// What wheels would say that turn too far and slip a little.
Pose2 bad_odometry_step(const Pose2& T_world_a, const Pose2& T_world_b) {
  const Pose2 step = T_world_a.inverse() * T_world_b;
  return {1.1 * step.x() + 0.005, step.y() - 0.004, 1.2 * step.theta() - 0.01};
}

struct Drive {
  std::vector<LocalFix> fixes;
  std::vector<Pose2> T_start_robot;  // the truth
};

Drive drive(LocalMapper* mapper,
            SimulatedLaser* laser,
            int steps,
            const std::function<Pose2(int)>& way,
            bool with_odometry = true) {
  Drive drive;
  Pose2 T_odom_robot(7.0, -3.0, 2.0);
  for (int i = 0; i < steps; ++i) {
    if (i > 0) {
      T_odom_robot = T_odom_robot * bad_odometry_step(way(i - 1), way(i));
    }
    JoinedScan joined{laser->scan(way(i), kScanPeriod_s * i), std::nullopt};
    if (with_odometry) {
      joined.T_odom_robot = T_odom_robot;
    }
    drive.fixes.push_back(mapper->absorb(joined));
    drive.T_start_robot.push_back(way(0).inverse() * way(i));
  }
  return drive;
}

TEST(LocalMapper, TracksThroughARoomInSpiteOfBadOdometry) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  const Drive tour = drive(&mapper, &laser, 150, on_a_circle);
  for (std::size_t i = 0; i < tour.fixes.size(); ++i) {
    SCOPED_TRACE(i);
    const LocalFix& fix = tour.fixes[i];
    EXPECT_LT(distance_m(fix.T_lpm_robot, tour.T_start_robot[i]), 0.15);
    EXPECT_NEAR(turn_between(fix.T_lpm_robot.theta(), tour.T_start_robot[i].theta()), 0.0, 0.06);
    EXPECT_TRUE(i == 0 || fix.is_matched) << to_string(fix.note);
    EXPECT_FALSE(i > 0 && fix.is_degenerate);
  }
}

TEST(LocalMapper, TracksWithoutOdometry) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  const Drive tour = drive(&mapper, &laser, 100, on_a_circle, false);
  EXPECT_LT(distance_m(tour.fixes.back().T_lpm_robot, tour.T_start_robot.back()), 0.20);
}

TEST(LocalMapper, GivesPositiveDefiniteCovariancesAlways) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  const auto rests_then_jumps = [](int i) { return i < 20 ? Pose2() : on_a_circle(i / 10 * 10); };
  for (const LocalFix& fix : drive(&mapper, &laser, 60, rests_then_jumps).fixes) {
    EXPECT_TRUE(is_positive_definite(fix.covariance));
    EXPECT_TRUE(is_positive_definite(fix.motion.covariance));
  }
}

TEST(LocalMapper, MotionsCompoundToThePoses) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  const Drive tour = drive(&mapper, &laser, 50, on_a_circle);
  Pose2 T_start_robot;
  for (const LocalFix& fix : tour.fixes) {
    T_start_robot = T_start_robot * fix.motion.mean;
    EXPECT_LT(distance_m(T_start_robot, fix.T_lpm_robot), 1e-9);
  }
}

TEST(LocalMapper, HoldsLessThanEightMebibytes) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  drive(&mapper, &laser, 200, on_a_circle);
  EXPECT_LT(mapper.memory_bytes(), 8U * 1024U * 1024U);
}

TEST(LocalMapper, HoldsLessThanEightMebibytesWhateverItSees) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  std::mt19937 random(3);
  std::uniform_real_distribution<float> range_m(0.6F, 30.0F);
  for (int i = 0; i < 100; ++i) {
    JoinedScan joined{laser.scan(on_a_circle(i), 0.1 * i), on_a_circle(i)};
    joined.scan.max_range_m = 80.0;
    for (float& one_m : joined.scan.ranges_m) {
      one_m = range_m(random);
    }
    mapper.absorb(joined);
    ASSERT_LT(mapper.memory_bytes(), 8U * 1024U * 1024U) << i;
  }
}

TEST(LocalMapper, DoesNotDriftAtRest) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  JoinedScan joined;
  GaussianPose T_start_robot;
  for (int i = 0; i < 300; ++i) {
    const LocalFix fix = mapper.absorb({laser.scan(Pose2(0.5, 0.3, 0.2), 0.1 * i), Pose2()});
    EXPECT_LT(fix.T_lpm_robot.translation().norm(), 0.02);
    T_start_robot = compounded(T_start_robot, fix.motion);
  }
  EXPECT_LT(std::sqrt(T_start_robot.covariance(0, 0)), 0.05);
}

TEST(LocalMapper, SaysThatACorridorLeavesTheWayAlongItOpen) {
  LocalMapper mapper;
  SimulatedLaser laser(endless_corridor());
  const auto along = [](int i) { return Pose2(0.1 * i, 0.0, 0.0); };
  const Drive tour = drive(&mapper, &laser, 30, along);
  const LocalFix& last = tour.fixes.back();
  EXPECT_TRUE(last.is_degenerate);
  EXPECT_GT(last.covariance(0, 0), 25.0 * last.covariance(1, 1));
  EXPECT_GT(last.motion.covariance(0, 0), 4.0 * last.motion.covariance(1, 1));
}

TEST(LocalMapper, RefusesAScanWithoutReturnsAndGoesOnByOdometry) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  drive(&mapper, &laser, 10, [](int) { return Pose2(); });
  LaserScan blind = laser.scan(Pose2(), 3.0);
  std::fill(blind.ranges_m.begin(), blind.ranges_m.end(), std::numeric_limits<float>::infinity());
  mapper.absorb({blind, Pose2()});
  const LocalFix fix = mapper.absorb({blind, Pose2(0.2, 0.0, 0.1)});
  EXPECT_FALSE(fix.is_matched);
  EXPECT_EQ(fix.note, FixNote::kBlockedSensor);
  EXPECT_NEAR(fix.motion.mean.x(), 0.2, 1e-12);
  EXPECT_TRUE(is_positive_definite(fix.motion.covariance));
}

TEST(LocalMapper, ReportsSlip) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  for (int i = 0; i < 10; ++i) {
    mapper.absorb({laser.scan(Pose2(), 0.2 * i), Pose2()});
  }
  const LocalFix turned = mapper.absorb({laser.scan(Pose2(), 2.0), Pose2(0.0, 0.0, 0.3)});
  EXPECT_EQ(turned.note, FixNote::kMatched) << "wheels may turn too far by a third";
  EXPECT_NEAR(turned.T_lpm_robot.theta(), 0.0, 0.02);
  const Pose2 pushed(0.0, 0.0, 0.25);
  const LocalFix slipped = mapper.absorb({laser.scan(pushed, 2.2), Pose2(0.0, 0.0, 0.3)});
  EXPECT_EQ(slipped.note, FixNote::kSlip);
  EXPECT_NEAR(slipped.T_lpm_robot.theta(), 0.25, 0.02);
}

TEST(LocalMapper, DoesNotBelieveOdometryThatJumps) {
  LocalMapper mapper;
  SimulatedLaser laser(furnished_room());
  drive(&mapper, &laser, 10, [](int) { return Pose2(); });
  mapper.absorb({laser.scan(Pose2(), 2.0), Pose2()});
  const LocalFix fix = mapper.absorb({laser.scan(Pose2(), 2.2), Pose2(50.0, 3.0, 1.0)});
  EXPECT_EQ(fix.note, FixNote::kTeleport);
  EXPECT_LT(fix.motion.mean.translation().norm(), 0.05);
}

TEST(LocalMapper, StartsAfreshWhenItIsElsewhere) {
  LocalMapper mapper;
  SimulatedLaser room(furnished_room());
  for (int i = 0; i < 10; ++i) {
    mapper.absorb({room.scan(Pose2(), 0.2 * i), Pose2()});
  }
  std::vector<test::Wall> walls;
  add_box({-0.8, -2.5}, {1.0, 0.9}, &walls);
  walls.push_back({{-0.8, -2.0}, {-0.2, -2.5}});
  SimulatedLaser elsewhere(walls);
  std::vector<FixNote> notes;
  for (int i = 0; i < 12; ++i) {
    const Pose2 moved(0.05 * i, 0.0, 0.0);
    notes.push_back(mapper.absorb({elsewhere.scan(moved, 2.0 + 0.2 * i), moved}).note);
  }
  EXPECT_EQ(notes[1], FixNote::kContradiction);
  EXPECT_EQ(notes.back(), FixNote::kMatched);
  EXPECT_EQ(mapper.restarts(), 1);
  EXPECT_EQ(mapper.renewals(), 0) << "the way there is not known";
}

TEST(LocalMapper, IsTheSameForTheSameScans) {
  const auto last_pose = [] {
    LocalMapper mapper;
    SimulatedLaser laser(furnished_room());
    return drive(&mapper, &laser, 60, on_a_circle).fixes.back().T_lpm_robot;
  };
  EXPECT_EQ(last_pose(), last_pose());
}

TEST(LocalMapper, GoesOnWhereRestoredScansLeftOff) {
  SimulatedLaser laser(furnished_room());
  LocalMapper restored;
  for (int i = 0; i < 30; ++i) {
    restored.restore(laser.scan(on_a_circle(i), 0.2 * i), on_a_circle(i), std::nullopt);
  }
  const LocalFix fix = restored.absorb({laser.scan(on_a_circle(31), 100.0), Pose2()});
  EXPECT_TRUE(fix.is_matched) << to_string(fix.note);
  EXPECT_LT(distance_m(fix.T_lpm_robot, on_a_circle(31)), 0.03);
}

TEST(LpmOptions, NameEveryFieldThatIsOutOfRange) {
  EXPECT_TRUE(validate(LpmOptions{}).ok());
  LpmOptions options;
  options.map.cell_m = 0.0;
  options.match.min_returns = 0;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("lpm.map.cell_m"));
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("lpm.match.min_returns"));
}

}  // namespace
}  // namespace cairn
