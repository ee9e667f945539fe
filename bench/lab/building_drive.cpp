#include "bench/lab/building_drive.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include "clients/sim/random_source.hpp"
#include "clients/sim/simulation.hpp"
#include "lpm/local_mapper.hpp"
#include "sensing/scan_joiner.hpp"

namespace cairn::lab {
namespace {

/// A place is that of a junction in its midst, or so near.
constexpr double kNear_m = 2.0;

/// Perceives what the simulation's sensors say.
class Perceiving : public sim::Recorder {
 public:
  Perceiving(const Building& building, int session, std::vector<SimulatedVisit>* visits)
      : building_(building), session_(session), visits_(visits), detector_(PlaceOptions()) {}

  void record_odometry(std::int64_t time_us, const sim::Pose& T_odom_robot) override {
    joiner_.add(OdometrySample{stamp(time_us), pose_of(T_odom_robot)});
    perceive();
  }
  void record_sweep(std::int64_t time_us, const sim::Sweep& sweep) override {
    LaserScan scan;
    scan.time = stamp(time_us);
    scan.ranges_m = sweep.ranges_m;
    scan.max_range_m = sweep.max_range_m;
    for (std::size_t i = 0; i < sweep.ranges_m.size(); ++i) {
      scan.bearings_rad.push_back(static_cast<float>(
          sweep.first_bearing_rad + static_cast<double>(i) * sweep.bearing_step_rad));
    }
    T_world_robot_[scan.time] = pose_of(sweep.T_world_robot);
    joiner_.add(std::move(scan));
    perceive();
  }
  void record_passage(const sim::Passage& /*passage*/) override {}

  void finish() {
    joiner_.flush();
    perceive();
    for (PlaceVisit& visit : detector_.finish()) {
      note(std::move(visit));
    }
  }

 private:
  static TimePoint stamp(std::int64_t time_us) { return time_of_utime(1'000'000 + time_us); }
  static Pose2 pose_of(const sim::Pose& pose) { return {pose.at.x_m, pose.at.y_m, pose.theta_rad}; }

  void perceive() {
    while (const std::optional<JoinedScan> joined = joiner_.next()) {
      const LocalFix fix = mapper_.absorb(*joined);
      for (PlaceEvent& event : detector_.observe(fix.time, fix.T_lpm_robot, mapper_.grid())) {
        if (event.visit) {
          note(*std::move(event.visit));
        }
      }
    }
  }

  void note(PlaceVisit visit) {
    const auto truth = T_world_robot_.find(visit.entered);
    if (truth == T_world_robot_.end() || visit.neighbourhood.gateways.empty()) {
      return;
    }
    const Pose2 T_world_place = truth->second * visit.T_place_robot_at_entry.inverse();
    const std::optional<int> junction =
        building_.junction_near(T_world_place * visit.neighbourhood.center,
                                std::max(kNear_m, visit.neighbourhood.radius_m));
    visits_->push_back({std::move(visit), T_world_place, junction, session_});
  }

  const Building& building_;
  int session_;
  std::vector<SimulatedVisit>* visits_;
  ScanJoiner joiner_;
  LocalMapper mapper_;
  PlaceDetector detector_;
  std::map<TimePoint, Pose2> T_world_robot_;
};

/// A robot of some make: how far and wide it sees, how well it drives.
sim::SimulationOptions some_robot(std::uint64_t seed) {
  sim::RandomSource random(seed, 100);
  sim::SimulationOptions options;
  options.seed = seed;
  options.laser_rate_hz = 4.0;
  options.driver.speed_m_per_s = 1.0;
  options.laser.beams = 181;
  options.laser.fov_deg = random.uniform() < 0.5 ? 180.0 : 270.0;
  options.laser.max_range_m = random.uniform() < 0.5 ? 10.0 : 20.0;
  options.laser.noise_sigma_m = 0.01 + 0.02 * random.uniform();
  return options;
}

}  // namespace

std::vector<SimulatedVisit> drive_building(const Building& building,
                                           std::uint64_t seed,
                                           int session,
                                           int travels) {
  std::vector<SimulatedVisit> visits;
  const sim::World world = building.session(session, travels);
  Perceiving perceiving(building, session, &visits);
  const std::atomic<bool> stop{false};
  sim::simulate(world, world.tours.front(),
                some_robot(1000 * seed + static_cast<std::uint64_t>(session)), stop, perceiving);
  perceiving.finish();
  return visits;
}

}  // namespace cairn::lab
