#include "lpm/motion_watch.hpp"

#include <functional>
#include <map>
#include <random>

#include <gmock/gmock.h>

#include "lpm/motion_model.hpp"

namespace cairn {
namespace {

constexpr double kPeriod_s = 0.2;
constexpr int kFaultAt = 200;
constexpr int kFaultSteps = 10;
constexpr int kSeeds = 50;

/// What is real, what wheels say and what the scan matcher says of one step.
struct World {
  Pose2 truth;
  Pose2 odometry;
  Pose2 matched;
  bool is_scan_repeated = false;
};

/// Spoils a step of the fault under test; `since` counts from its first step.
using Spoil = std::function<void(int since, World*)>;

Pose2 arc(double drive_m, double turn_rad) {
  return {Pose2(0.0, 0.0, 0.5 * turn_rad) * Vector2d(drive_m, 0.0), turn_rad};
}

/// Drives on with gentle bends, with wheels that err by a few per cent and a learned model. Returns
/// how often each fault was named at and after the fault began, and before it.
struct Named {
  std::map<MotionFault, int> before;
  std::map<MotionFault, int> during;
  std::map<MotionFault, int> after;
};

Named drive(unsigned seed,
            const Spoil& spoil,
            int fault_steps = kFaultSteps,
            int steps = 230,
            double noise = 1.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  MotionModel model;
  MotionWatch watch;
  Named named;
  double turn_rad = 0.0;
  for (int i = 0; i < steps; ++i) {
    turn_rad = 0.9 * turn_rad + 0.03 * normal(random);
    World world;
    world.truth = arc(0.1, turn_rad);
    world.odometry = arc(0.104 + 0.004 * noise * normal(random),
                         1.05 * turn_rad + 0.006 * noise * normal(random));
    const bool is_faulty = i >= kFaultAt && i < kFaultAt + fault_steps;
    world.matched = world.truth;
    if (is_faulty) {
      spoil(i - kFaultAt, &world);
    }
    MotionEvidence evidence;
    evidence.dt_s = kPeriod_s;
    evidence.odometry_step = world.odometry;
    evidence.predicted = model.predict(world.odometry);
    evidence.matched.mean = Pose2(world.matched.x() + 0.004 * normal(random),
                                  world.matched.y() + 0.004 * normal(random),
                                  world.matched.theta() + 0.002 * normal(random));
    evidence.matched.covariance = Eigen::Vector3d(1.6e-5, 1.6e-5, 4e-6).asDiagonal();
    evidence.is_scan_repeated = world.is_scan_repeated;
    const MotionFault fault = watch.judge(evidence);
    ++(is_faulty ? named.during : (i < kFaultAt ? named.before : named.after))[fault];
    if (fault == MotionFault::kNone) {
      model.learn(world.odometry, evidence.matched);
    } else {
      model.skip();
    }
  }
  return named;
}

/// In how many of the runs the fault was named while it lasted.
int detections(MotionFault fault, const Spoil& spoil, int fault_steps = kFaultSteps) {
  int detected = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    detected += drive(seed, spoil, fault_steps, kFaultAt + fault_steps).during.count(fault) > 0;
  }
  return detected;
}

TEST(MotionWatch, HardlyEverBlamesHonestOdometry) {
  int alarms = 0;
  int steps = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const Named named = drive(
        seed, [](int, World*) {}, 0, 400);
    for (const auto* part : {&named.before, &named.after}) {
      for (const auto& [fault, count] : *part) {
        alarms += fault == MotionFault::kNone ? 0 : count;
        steps += count;
      }
    }
  }
  EXPECT_EQ(steps, 400 * kSeeds);
  EXPECT_LE(alarms, steps / 2'000);
}

TEST(MotionWatch, NamesWheelsThatSpin) {
  EXPECT_GE(detections(MotionFault::kSlip,
                       [](int, World* world) { world->truth = world->matched = arc(0.02, 0.0); }),
            kSeeds - 2);
}

TEST(MotionWatch, NamesWheelsThatSpinInATurn) {
  EXPECT_GE(detections(MotionFault::kSlip,
                       [](int, World* world) {
                         world->odometry = arc(0.0, 0.15);
                         world->matched = arc(0.0, 0.05);
                       }),
            kSeeds - 2);
}

TEST(MotionWatch, NamesARobotThatIsCarried) {
  EXPECT_GE(detections(MotionFault::kCarried,
                       [](int since, World* world) {
                         world->odometry = Pose2(0.0, 0.0, 0.0);
                         world->matched = Pose2(0.01, 0.05, 0.02 * since);
                       }),
            kSeeds - 2);
}

TEST(MotionWatch, NamesOdometryThatStalls) {
  EXPECT_GE(detections(MotionFault::kOdometryStalled,
                       [](int, World* world) { world->odometry = Pose2(); }),
            kSeeds - 2);
}

TEST(MotionWatch, TellsOdometryThatStandsStillForLongFromARobotThatIsCarried) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    // It stood when odometry froze, and set off later.
    const Spoil drives_off = [](int since, World* world) {
      world->odometry = since == 0 ? arc(0.002, 0.0) : Pose2();
      world->truth = world->matched = since < 20 ? world->odometry : arc(0.1, 0.02);
    };
    const Named stalled = drive(seed, drives_off, 60, 260);
    EXPECT_GE(stalled.during.count(MotionFault::kOdometryStalled) > 0
                  ? stalled.during.at(MotionFault::kOdometryStalled)
                  : 0,
              30)
        << seed;
    const Spoil is_carried = [](int since, World* world) {
      world->odometry = Pose2();
      world->truth = world->matched = since < 20 ? Pose2() : Pose2(0.05, 0.06, 0.02);
    };
    const Named carried = drive(seed, is_carried, 60, 260);
    EXPECT_GE(carried.during.count(MotionFault::kCarried) > 0
                  ? carried.during.at(MotionFault::kCarried)
                  : 0,
              30)
        << seed;
  }
}

TEST(MotionWatch, NamesScansThatRepeatThemselves) {
  EXPECT_GE(detections(MotionFault::kScanStalled,
                       [](int, World* world) {
                         world->matched = Pose2();
                         world->is_scan_repeated = true;
                       }),
            kSeeds - 2);
}

TEST(MotionWatch, NamesABumpAtOnceAndOnce) {
  const Spoil sideways = [](int, World* world) { world->matched = Pose2(0.05, 0.2, 0.0); };
  const Spoil around = [](int, World* world) { world->matched = Pose2(0.1, 0.0, 0.5); };
  EXPECT_GE(detections(MotionFault::kBump, sideways, 1), kSeeds - 2);
  EXPECT_GE(detections(MotionFault::kBump, around, 1), kSeeds - 2);
  const Named named = drive(1, sideways, 1);
  EXPECT_EQ(named.after.at(MotionFault::kNone), 230 - kFaultAt - 1);
}

TEST(MotionWatch, NamesATeleport) {
  EXPECT_EQ(detections(
                MotionFault::kTeleport,
                [](int, World* world) { world->odometry = Pose2(4.0, -3.0, 1.0); }, 1),
            kSeeds);
}

TEST(MotionWatch, NamesALaserThatLooksBackWhenItHasTravelled) {
  const auto reversed = [](int, World* world) {
    world->matched = Pose2(-world->truth.x(), -world->truth.y(), world->truth.theta());
  };
  EXPECT_EQ(detections(MotionFault::kLaserReversed, reversed, 120), kSeeds);
  EXPECT_EQ(detections(MotionFault::kLaserReversed, reversed, 5), 0) << "not before it is certain";
}

TEST(MotionWatch, NamesALaserThatHangsUpsideDownWhenItHasTurned) {
  const auto upside_down = [](int, World* world) {
    world->odometry = arc(0.05, 0.2);
    world->matched = arc(0.05, -0.2);
  };
  EXPECT_EQ(detections(MotionFault::kLaserUpsideDown, upside_down, 60), kSeeds);
}

TEST(MotionWatch, IsSilentAgainSomeStepsAfterAFault) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const Named named = drive(seed, [](int, World* world) { world->matched = Pose2(); });
    EXPECT_GE(named.after.at(MotionFault::kNone), 15) << seed;
  }
}

TEST(MotionWatch, HasANameForEveryFault) {
  EXPECT_EQ(to_string(MotionFault::kLaserUpsideDown), "laser upside down");
  EXPECT_EQ(to_string(MotionFault::kOdometryStalled), "odometry stalled");
}

}  // namespace
}  // namespace cairn
