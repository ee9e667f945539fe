#include "bench/lab/places_run.hpp"

#include <optional>
#include <utility>

#include "bench/lab/log_feed.hpp"
#include "bench/lab/resources.hpp"
#include "lpm/local_mapper.hpp"

namespace cairn::lab {
namespace {

/// The local layer and the place detector.
class Detecting {
 public:
  Detecting(const DaemonOptions& options, PlacesRun* run)
      : run_(run),
        joiner_(options.service.joiner),
        mapper_(options.service.lpm),
        detector_(options.service.place) {}

  void take(LaserScan scan) {
    joiner_.add(std::move(scan));
    perceive();
  }
  void take(const OdometrySample& sample) {
    joiner_.add(sample);
    perceive();
  }
  void finish() {
    joiner_.flush();
    perceive();
    for (PlaceVisit& visit : detector_.finish()) {
      run_->visits.push_back(std::move(visit));
    }
    run_->report = detector_.report();
  }

 private:
  void perceive() {
    while (const std::optional<JoinedScan> joined = joiner_.next()) {
      const LocalFix fix = mapper_.absorb(*joined);
      const double start_s = cpu_time_s();
      for (PlaceEvent& event : detector_.observe(fix.time, fix.T_lpm_robot, mapper_.grid())) {
        if (event.visit) {
          run_->visits.push_back(*std::move(event.visit));
        }
      }
      run_->perception.times_ms.push_back(1e3 * (cpu_time_s() - start_s));
      if (detector_.report().looks != looks_) {
        looks_ = detector_.report().looks;
        run_->poses.push_back({seconds_of(fix.time), fix.T_lpm_robot, detector_.island()});
      }
    }
  }

  PlacesRun* run_;
  ScanJoiner joiner_;
  LocalMapper mapper_;
  PlaceDetector detector_;
  std::int64_t looks_ = 0;
};

}  // namespace

PlacesRun run_places(const std::string& log, const DaemonOptions& options) {
  PlacesRun run;
  Detecting detecting(options, &run);
  run.damage = feed_log(log, options,
                        {[&](LaserScan scan) { detecting.take(std::move(scan)); },
                         [&](const OdometrySample& sample) { detecting.take(sample); },
                         {},
                         {},
                         {}});
  detecting.finish();
  if (run.perception.times_ms.empty()) {
    refuse_without_scans(log, run.damage);
  }
  return run;
}

}  // namespace cairn::lab
