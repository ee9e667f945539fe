#include "bench/lab/recognition_pairs.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include "clients/common/progress.hpp"
#include "clients/sim/random_source.hpp"
#include "clients/sim/simulation.hpp"
#include "geometry/angle.hpp"
#include "lpm/local_mapper.hpp"
#include "sensing/scan_joiner.hpp"
#include "topology/reading_match.hpp"

namespace cairn::lab {
namespace {

constexpr int kTravels = 16;
constexpr double kSameWay_rad = 0.8;  // between the bearings of one gateway

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
        building_.junction_near(T_world_place * visit.neighbourhood.center);
    if (junction) {
      visits_->push_back({std::move(visit), T_world_place, *junction, session_});
    }
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

/// The gateways of the earlier visit that the later one's gateway of arrival may be.
std::vector<GatewayPair> alignments(const PlaceVisit& known, const PlaceVisit& visit) {
  static constexpr MisreadingCosts kAnyMisreading{1.0, 1.0, 1.0};
  const int arrival = std::max(visit.arrival_gateway, 0);
  const View view{visit.neighbourhood.star, arrival, VisitId{1}};
  std::vector<GatewayPair> pairs;
  for (int g = 0; g < static_cast<int>(known.neighbourhood.gateways.size()); ++g) {
    if (match_reading(view, known.neighbourhood.star, g, kAnyMisreading).is_possible()) {
      pairs.push_back({g, arrival});
    }
  }
  return pairs;
}

double world_bearing_rad(const SimulatedVisit& visit, int gateway) {
  return visit.T_world_place.theta() +
         visit.perceived.neighbourhood.gateways[static_cast<std::size_t>(gateway)]
             .outward_bearing_rad;
}

bool are_true(const SimulatedVisit& known,
              const SimulatedVisit& visit,
              const std::vector<GatewayPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const GatewayPair& pair) {
    return std::abs(turn_between(world_bearing_rad(known, pair.known),
                                 world_bearing_rad(visit, pair.visit))) < kSameWay_rad;
  });
}

int gateway_count(const SimulatedVisit& visit) {
  return static_cast<int>(visit.perceived.neighbourhood.gateways.size());
}

JudgedPair judged(const SimulatedVisit& known,
                  const SimulatedVisit& visit,
                  const std::vector<GatewayPair>& pairs,
                  const MapMatch& match) {
  JudgedPair pair;
  pair.is_same_junction = known.junction == visit.junction;
  pair.is_same = pair.is_same_junction && are_true(known, visit, pairs);
  pair.is_other_session = known.session != visit.session;
  pair.match = match;
  if (pair.is_same) {
    pair.chi2 = squared_mahalanobis(match.T_reference_other.mean,
                                    known.T_world_place.inverse() * visit.T_world_place,
                                    match.T_reference_other.covariance);
  }
  return pair;
}

}  // namespace

std::vector<SimulatedVisit> visits_of_session(const Building& building,
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

std::vector<JudgedPair> judged_pairs(const std::vector<SimulatedVisit>& visits,
                                     const MapMatchOptions& options) {
  std::vector<MatchableMap> maps;
  maps.reserve(visits.size());
  for (const SimulatedVisit& visit : visits) {
    maps.emplace_back(visit.perceived.lpm, options);
  }
  std::vector<JudgedPair> all;
  for (std::size_t later = 1; later < visits.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const SimulatedVisit& known = visits[earlier];
      const SimulatedVisit& visit = visits[later];
      for (const GatewayPair& pair : alignments(known.perceived, visit.perceived)) {
        const std::vector<GatewayPair> pairs =
            paired_gateways(gateway_count(known), gateway_count(visit), pair);
        const Pose2 guess = aligned_by_gateways(known.perceived, visit.perceived, pairs);
        all.push_back(
            judged(known, visit, pairs, match_maps(maps[earlier], maps[later], guess, options)));
      }
    }
  }
  return all;
}

std::vector<JudgedPair> judged_buildings(std::uint64_t first_seed, int count) {
  std::vector<JudgedPair> all;
  clients::Progress progress("buildings");
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const Building building(seed);
    std::vector<SimulatedVisit> visits;
    for (const int session : {0, 1}) {
      for (SimulatedVisit& visit : visits_of_session(building, seed, session, kTravels)) {
        visits.push_back(std::move(visit));
      }
    }
    for (JudgedPair& pair : judged_pairs(visits, MapMatchOptions())) {
      pair.seed = seed;
      pair.repeats_itself = building.repeats_itself();
      all.push_back(std::move(pair));
    }
    progress.show(i + 1, count);
  }
  return all;
}

}  // namespace cairn::lab
