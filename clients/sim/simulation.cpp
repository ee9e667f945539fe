#include "clients/sim/simulation.hpp"

#include <cmath>
#include <utility>

namespace cairn::sim {
namespace {

constexpr std::int64_t kStep_us = 10'000;
constexpr std::int64_t kStand_us = 1'000'000;
/// The sensors of a real robot are not in step with each other either.
constexpr std::int64_t kFirstSweep_us = 30'000;
constexpr double kPassageWithin_m = 0.75;
constexpr double kPassageOver_m = 1.0;

/// Drives the robot and knows when its tour is over.
class Robot {
 public:
  Robot(const World& world, const Tour& tour, const DriverOptions& options)
      : driver_(path_of(world, tour), start_of(world, tour), options) {}

  [[nodiscard]] const Pose& pose() const { return driver_.pose(); }
  [[nodiscard]] bool is_done() const { return driver_.has_arrived() && stood_us_ >= kStand_us; }
  [[nodiscard]] bool has_arrived() const { return driver_.has_arrived(); }

  Motion advance(std::int64_t time_us) {
    if (time_us < kStand_us) {
      return {};
    }
    if (driver_.has_arrived()) {
      stood_us_ += kStep_us;
      return {};
    }
    return driver_.advance(static_cast<double>(kStep_us) * 1e-6);
  }

 private:
  Driver driver_;
  std::int64_t stood_us_ = 0;
};

/// Notices when the robot passes named points.
class PassageWatch {
 public:
  explicit PassageWatch(const std::vector<NamedPoint>& junctions) : junctions_(junctions) {}

  void observe(std::int64_t time_us, Point robot, Recorder& recorder) {
    if (current_ != nullptr) {
      follow(time_us, robot, recorder);
      return;
    }
    for (const NamedPoint& junction : junctions_) {
      if (distance_m(robot, junction.at) < kPassageWithin_m) {
        current_ = &junction;
        nearest_m_ = distance_m(robot, junction.at);
        nearest_us_ = time_us;
        return;
      }
    }
  }

  void finish(Recorder& recorder) {
    if (current_ != nullptr) {
      recorder.record_passage({nearest_us_, *current_});
      current_ = nullptr;
    }
  }

 private:
  void follow(std::int64_t time_us, Point robot, Recorder& recorder) {
    const double away_m = distance_m(robot, current_->at);
    if (away_m < nearest_m_) {
      nearest_m_ = away_m;
      nearest_us_ = time_us;
    } else if (away_m > kPassageOver_m) {
      finish(recorder);
    }
  }

  const std::vector<NamedPoint>& junctions_;
  const NamedPoint* current_ = nullptr;
  double nearest_m_ = 0.0;
  std::int64_t nearest_us_ = 0;
};

/// Says when a sensor's next reading is due.
class Timer {
 public:
  Timer(std::int64_t first_us, double rate_hz)
      : next_us_(first_us), period_us_(std::llround(1e6 / rate_hz)) {}

  bool is_due(std::int64_t time_us) {
    const bool is_due = time_us >= next_us_;
    next_us_ += is_due ? period_us_ : 0;
    return is_due;
  }

 private:
  std::int64_t next_us_;
  std::int64_t period_us_;
};

/// The pose in the world that dead reckoning gives, had it begun at the true start.
Pose reckoned_in_world(const Pose& start, const Pose& T_odom_robot) {
  const double c = std::cos(start.theta_rad);
  const double s = std::sin(start.theta_rad);
  const Point& at = T_odom_robot.at;
  return {{start.at.x_m + c * at.x_m - s * at.y_m, start.at.y_m + s * at.x_m + c * at.y_m},
          wrap_angle(start.theta_rad + T_odom_robot.theta_rad)};
}

}  // namespace

DriveReport simulate(const World& world,
                     const Tour& tour,
                     const SimulationOptions& options,
                     const std::atomic<bool>& stop,
                     Recorder& recorder) {
  Robot robot(world, tour, options.driver);
  Laser laser(options.laser, options.seed);
  Odometer odometer(options.odometer, options.seed);
  PassageWatch watch(world.junctions);
  Timer odometry_timer(0, options.odometry_rate_hz);
  Timer sweep_timer(kFirstSweep_us, options.laser_rate_hz);
  DriveReport report;
  for (; !robot.is_done() && !stop; report.duration_us += kStep_us) {
    const std::int64_t time_us = report.duration_us;
    if (odometry_timer.is_due(time_us)) {
      recorder.record_odometry(time_us, odometer.pose());
    }
    if (sweep_timer.is_due(time_us)) {
      recorder.record_sweep(
          time_us, {laser.first_bearing_rad(), laser.bearing_step_rad(), laser.max_range_m(),
                    laser.sweep(world.plan, robot.pose()), robot.pose()});
    }
    watch.observe(time_us, robot.pose().at, recorder);
    const Motion motion = robot.advance(time_us);
    odometer.add(motion);
    report.travelled_m += motion.distance_m;
  }
  watch.finish(recorder);
  const Pose reckoned = reckoned_in_world(start_of(world, tour), odometer.pose());
  report.odometry_error_m = distance_m(reckoned.at, robot.pose().at);
  report.odometry_error_rad = std::abs(wrap_angle(reckoned.theta_rad - robot.pose().theta_rad));
  report.has_arrived = robot.has_arrived();
  return report;
}

std::int64_t duration_of(const World& world, const Tour& tour, const SimulationOptions& options) {
  Robot robot(world, tour, options.driver);
  std::int64_t time_us = 0;
  for (; !robot.is_done(); time_us += kStep_us) {
    robot.advance(time_us);
  }
  return time_us;
}

}  // namespace cairn::sim
