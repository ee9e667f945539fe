#include "bench/lab/localmap_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "bench/lab/resources.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/progress.hpp"
#include "layout/trajectory.hpp"
#include "lpm/local_mapper.hpp"
#include "service/between_scans.hpp"
#include "transport/inlets.hpp"
#include "wire/log_reader.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

double seconds_of(TimePoint time) {
  return static_cast<double>(utime_of(time)) * 1e-6;
}

/// A trajectory has one pose at a time. Where stamps repeat, those of later messages are wrong.
std::vector<TrackedPose> first_of_each_stamp(std::vector<TrackedPose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const TrackedPose& a, const TrackedPose& b) { return a.time_s < b.time_s; });
  poses.erase(std::unique(poses.begin(), poses.end(),
                          [](const TrackedPose& a, const TrackedPose& b) {
                            return a.time_s == b.time_s;  // of whole microseconds, both
                          }),
              poses.end());
  return poses;
}

/// The local layer with a clock around its stages.
class Runner {
 public:
  Runner(const DaemonOptions& options, LocalmapRun* run)
      : run_(run), joiner_(options.service.joiner), mapper_(options.service.lpm) {}

  void take(LaserScan scan) {
    joiner_.add(std::move(scan));
    absorb_joined();
  }
  void take(const OdometrySample& sample) {
    joiner_.add(sample);
    between_.add(sample);
    absorb_joined();
  }
  void finish() {
    joiner_.flush();
    absorb_joined();
    run_->restarts = mapper_.restarts();
    run_->map_bytes = mapper_.memory_bytes();
    run_->joiner = joiner_.counters();
  }
  /// From here on time counts for the next scan.
  void start_clock() { mark_s_ = cpu_time_s(); }
  void stop_clock() { other_s_ += lap_s(); }

 private:
  double lap_s() {
    const double now_s = cpu_time_s();
    return now_s - std::exchange(mark_s_, now_s);
  }

  void absorb_joined() {
    while (const std::optional<JoinedScan> joined = joiner_.next()) {
      const double other_ms = 1e3 * (std::exchange(other_s_, 0.0) + lap_s());
      const LocalFix fix = mapper_.locate(*joined);
      const double matching_ms = 1e3 * lap_s();
      const bool is_drawn = mapper_.take_up(fix);
      const double insertion_ms = 1e3 * lap_s();
      run_->matching.times_ms.push_back(matching_ms);
      run_->insertion.times_ms.push_back(insertion_ms);
      run_->other.times_ms.push_back(other_ms);
      run_->all.times_ms.push_back(matching_ms + insertion_ms + other_ms);
      record(*joined, fix, is_drawn);
      start_clock();
    }
  }

  void record(const JoinedScan& joined, const LocalFix& fix, bool is_drawn) {
    keep_pose(joined, fix);
    ++run_->notes[to_string(fix.note)];
    if (fix.fault != MotionFault::kNone) {
      ++run_->faults[std::string(to_string(fix.fault))];
    }
    run_->refused += fix.is_matched || fix.note == FixNote::kFirst ? 0 : 1;
    run_->degenerate += fix.is_degenerate ? 1 : 0;
    if (is_drawn) {
      keep_walls(joined.scan, fix.T_lpm_robot);
    }
  }

  void keep_pose(const JoinedScan& joined, const LocalFix& fix) {
    const std::vector<OdometrySample> between = between_.take(fix.time, joined.T_odom_robot);
    TrackedPose here{seconds_of(fix.time), fix.T_lpm_robot, 0.0};
    if (!run_->track.empty()) {
      const TrackedPose& last = run_->track.back();
      const Vector2d step = here.T_lpm_robot.translation() - last.T_lpm_robot.translation();
      here.travel_m = last.travel_m + step.norm();
      keep_between(between, last, here);
    }
    run_->track.push_back(here);
    run_->poses.push_back(here);
  }

  void keep_between(const std::vector<OdometrySample>& between,
                    const TrackedPose& last,
                    const TrackedPose& here) {
    std::vector<Pose2> T_previous_robot{Pose2()};
    for (const OdometrySample& sample : between) {
      T_previous_robot.push_back(sample.T_odom_robot);
    }
    const std::vector<Pose2> bent =
        interpolate_travel(T_previous_robot, last.T_lpm_robot, here.T_lpm_robot);
    for (std::size_t i = 0; i + 1 < between.size(); ++i) {
      run_->poses.push_back({seconds_of(between[i].time), bent[i + 1], here.travel_m});
    }
  }

  void keep_walls(const LaserScan& scan, const Pose2& T_lpm_robot) {
    constexpr double kFar_m = 15.0;
    const Pose2 T_lpm_laser = T_lpm_robot * scan.T_robot_laser;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double range_m = static_cast<double>(scan.ranges_m[i]);
      if (range_m <= std::min(scan.max_range_m, kFar_m)) {
        const double bearing_rad = static_cast<double>(scan.bearings_rad[i]);
        run_->walls_lpm.push_back(T_lpm_laser * Vector2d(range_m * std::cos(bearing_rad),
                                                         range_m * std::sin(bearing_rad)));
      }
    }
  }

  LocalmapRun* run_;
  ScanJoiner joiner_;
  BetweenScans between_;
  LocalMapper mapper_;
  double mark_s_ = 0.0;
  double other_s_ = 0.0;
};

}  // namespace

double StageTimes::mean_ms() const {
  return times_ms.empty() ? 0.0
                          : std::accumulate(times_ms.begin(), times_ms.end(), 0.0) /
                                static_cast<double>(times_ms.size());
}

double StageTimes::quantile_ms(double share) const {
  if (times_ms.empty()) {
    return 0.0;
  }
  std::vector<double> sorted = times_ms;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

DaemonOptions options_from_file(const std::string& config_file) {
  if (config_file.empty()) {
    return {};
  }
  const std::ifstream file(config_file);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    throw Failure(ExitCode::kBadData, config_file + ": cannot be read");
  }
  const Result<DaemonOptions> options = read_options(text.str());
  if (!options) {
    throw Failure(ExitCode::kBadData, config_file + ": " + options.error().message);
  }
  return *options;
}

LocalmapRun run_localmap(const std::string& log, const DaemonOptions& options) {
  wire::Expected<wire::LogReader> reader = wire::LogReader::open(log);
  if (!reader) {
    throw Failure(ExitCode::kBadData, reader.error());
  }
  LocalmapRun run;
  Runner runner(options, &run);
  Inlets inlets(
      to_inlet_options(options),
      {[&](LaserScan scan) { runner.take(std::move(scan)); },
       [&](const OdometrySample& sample) { runner.take(sample); }, [](const SonarRing&) {}});
  clients::Progress progress(log);
  while (const std::optional<wire::LogMessage> message = reader->next()) {
    runner.start_clock();
    inlets.dispatch(message->channel, message->bytes.data(), message->bytes.size());
    runner.stop_clock();
    progress.show(reader->bytes_read(), reader->bytes_total());
  }
  runner.start_clock();
  runner.finish();
  if (run.track.empty()) {
    throw Failure(ExitCode::kBadData,
                  log + ": no scan in it" + (reader->damage() ? "; " + *reader->damage() : ""));
  }
  run.poses = first_of_each_stamp(std::move(run.poses));
  run.damage = reader->damage().value_or("");
  return run;
}

}  // namespace cairn::lab
