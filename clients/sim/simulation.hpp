#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "clients/sim/driver.hpp"
#include "clients/sim/laser.hpp"
#include "clients/sim/odometer.hpp"
#include "clients/sim/world.hpp"

namespace cairn::sim {

struct SimulationOptions {
  LaserOptions laser;
  OdometerOptions odometer;
  DriverOptions driver;
  double laser_rate_hz = 10.0;     ///< (0, 100]
  double odometry_rate_hz = 20.0;  ///< (0, 100]
  std::uint64_t seed = 1;          ///< Same seed, same world: same output, bit for bit.
};

/// One sweep and where the robot truly was.
struct Sweep {
  double first_bearing_rad = 0.0;
  double bearing_step_rad = 0.0;
  double max_range_m = 0.0;
  std::vector<float> ranges_m;
  Pose T_world_robot;
};

/// The robot's closest approach to a named point.
struct Passage {
  std::int64_t time_us = 0;
  NamedPoint junction;
};

/// Takes what the robot's sensors say, in the order of time; times are microseconds since the start
/// of the simulation.
class Recorder {
 public:
  Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder(Recorder&&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  Recorder& operator=(Recorder&&) = delete;
  virtual ~Recorder() = default;

  virtual void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) = 0;
  virtual void record_sweep(std::int64_t time_us, const Sweep& sweep) = 0;
  /// Comes when the robot has left the junction's neighbourhood, so later than the passage's time.
  virtual void record_passage(const Passage& passage) = 0;
};

/// What a drive amounted to.
struct DriveReport {
  std::int64_t duration_us = 0;
  double travelled_m = 0.0;
  double odometry_error_m = 0.0;    ///< Of the end by dead reckoning from the true start.
  double odometry_error_rad = 0.0;  ///< Absolute.
  bool has_arrived = false;         ///< Not: it was stopped.
};

/// Drives the tour once. The robot stands for a second at both ends.
/// @param stop ends the drive early when set
DriveReport simulate(const World& world,
                     const Tour& tour,
                     const SimulationOptions& options,
                     const std::atomic<bool>& stop,
                     Recorder& recorder);

/// How long `simulate` lets the robot drive, in simulated time.
[[nodiscard]] std::int64_t duration_of(const World& world,
                                       const Tour& tour,
                                       const SimulationOptions& options);

}  // namespace cairn::sim
