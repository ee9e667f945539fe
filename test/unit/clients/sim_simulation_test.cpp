#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "clients/sim/simulation.hpp"

namespace cairn::sim {
namespace {

using ::testing::ElementsAreArray;
using ::testing::Not;
using ::testing::SizeIs;

/// Keeps everything.
class Tape final : public Recorder {
 public:
  void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) override {
    EXPECT_GE(time_us, last_us_);
    last_us_ = time_us;
    odometry.push_back(T_odom_robot);
  }
  void record_sweep(std::int64_t time_us, const Sweep& sweep) override {
    EXPECT_GE(time_us, last_us_);
    last_us_ = time_us;
    sweeps.push_back(sweep);
  }
  void record_passage(const Passage& passage) override {
    passages.push_back(passage.junction.name);
  }

  std::vector<Pose> odometry;
  std::vector<Sweep> sweeps;
  std::vector<std::string> passages;

 private:
  std::int64_t last_us_ = 0;
};

World shipped(const std::string& name) {
  return read_world(std::filesystem::path(CAIRN_SOURCE_DIR) / "config/worlds" / (name + ".txt"));
}

/// Few beams: what is asked here is where the robot goes.
SimulationOptions with_few_beams() {
  SimulationOptions options;
  options.laser.beams = 2;
  return options;
}

DriveReport driven(const World& world,
                   const Tour& tour,
                   const SimulationOptions& options,
                   Tape& tape) {
  const std::atomic<bool> never{false};
  return simulate(world, tour, options, never, tape);
}

TEST(Simulation, EveryShippedTourStaysClearOfTheWalls) {
  for (const char* const name : {"office", "square", "lattice"}) {
    const World world = shipped(name);
    for (const Tour& tour : world.tours) {
      SCOPED_TRACE(std::string(name) + " " + tour.name);
      Tape tape;
      EXPECT_TRUE(driven(world, tour, with_few_beams(), tape).has_arrived);
      for (const Sweep& sweep : tape.sweeps) {
        ASSERT_GT(clearance_m(world.plan, sweep.T_world_robot.at, 1.0), 0.75);
      }
    }
  }
}

TEST(Simulation, PassesTheJunctionsOfItsTourInOrder) {
  const World world = shipped("square");
  const Tour& tour = tour_named(world, "stubs");
  Tape tape;
  driven(world, tour, with_few_beams(), tape);
  std::vector<std::string> expected;
  for (const NamedPoint& waypoint : tour.waypoints) {
    expected.push_back(waypoint.name);
  }
  EXPECT_THAT(tape.passages, ElementsAreArray(expected));
}

TEST(Simulation, KeepsTheRatesOfItsSensors) {
  const World world = shipped("square");
  Tape tape;
  const DriveReport report = driven(world, tour_named(world, "loop"), with_few_beams(), tape);
  const double duration_s = static_cast<double>(report.duration_us) * 1e-6;
  EXPECT_NEAR(static_cast<double>(tape.sweeps.size()), 10.0 * duration_s, 2.0);
  EXPECT_NEAR(static_cast<double>(tape.odometry.size()), 20.0 * duration_s, 2.0);
}

// The demonstration needs a drift that closes no loop by itself.
TEST(Simulation, OdometryOfTheDemoTourEndsMetresAndTensOfDegreesOff) {
  const World world = shipped("office");
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SimulationOptions options = with_few_beams();
    options.seed = seed;
    Tape tape;
    const DriveReport report = driven(world, tour_named(world, "demo"), options, tape);
    EXPECT_GT(report.odometry_error_m, 2.0);
    EXPECT_GT(report.odometry_error_rad, 20.0 * std::numbers::pi / 180.0);
    EXPECT_GT(report.travelled_m, 150.0);
    EXPECT_LT(report.travelled_m, 250.0);
  }
}

TEST(Simulation, WithoutDriftOdometryIsTheTruth) {
  const World world = shipped("square");
  SimulationOptions options = with_few_beams();
  options.odometer = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  Tape tape;
  const DriveReport report = driven(world, tour_named(world, "loop"), options, tape);
  EXPECT_LT(report.odometry_error_m, 1e-6);
  EXPECT_LT(report.odometry_error_rad, 1e-6);
}

TEST(Simulation, TheSameSeedSaysTheSameAndAnotherDoesNot) {
  const World world = shipped("square");
  const Tour& tour = tour_named(world, "loop");
  SimulationOptions options = with_few_beams();
  Tape first;
  Tape second;
  Tape other;
  driven(world, tour, options, first);
  driven(world, tour, options, second);
  options.seed = 2;
  driven(world, tour, options, other);
  EXPECT_EQ(first.odometry, second.odometry);
  EXPECT_EQ(first.sweeps.back().ranges_m, second.sweeps.back().ranges_m);
  EXPECT_NE(first.odometry.back(), other.odometry.back());
  EXPECT_THAT(first.sweeps.back().ranges_m, Not(ElementsAreArray(other.sweeps.back().ranges_m)));
}

TEST(Simulation, MoreBeamsDoNotChangeTheOdometry) {
  const World world = shipped("square");
  SimulationOptions options = with_few_beams();
  Tape few;
  Tape more;
  driven(world, tour_named(world, "loop"), options, few);
  options.laser.beams = 9;
  driven(world, tour_named(world, "loop"), options, more);
  EXPECT_EQ(few.odometry, more.odometry);
}

TEST(Simulation, ItsDurationIsKnownBeforehand) {
  const World world = shipped("square");
  const Tour& tour = tour_named(world, "twice");
  Tape tape;
  const DriveReport report = driven(world, tour, with_few_beams(), tape);
  EXPECT_EQ(duration_of(world, tour, with_few_beams()), report.duration_us);
}

TEST(Simulation, EndsWhenItIsStopped) {
  const World world = shipped("square");
  const std::atomic<bool> stopped{true};
  Tape tape;
  const DriveReport report =
      simulate(world, tour_named(world, "loop"), with_few_beams(), stopped, tape);
  EXPECT_FALSE(report.has_arrived);
  EXPECT_THAT(tape.sweeps, SizeIs(0));
}

}  // namespace
}  // namespace cairn::sim
