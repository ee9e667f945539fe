#include "bench/lab/localmap_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "bench/lab/log_feed.hpp"
#include "bench/lab/resources.hpp"
#include "clients/common/failure.hpp"
#include "layout/trajectory.hpp"
#include "lpm/local_mapper.hpp"
#include "service/between_scans.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

/// The mean of poses, as many as there are of scans if there are any.
TrackedPose mean_pose(const std::vector<TrackedPose>& poses, std::size_t begin, std::size_t end) {
  const auto is_of_scan = [](const TrackedPose& pose) { return pose.is_of_scan; };
  const auto first = poses.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = poses.begin() + static_cast<std::ptrdiff_t>(end);
  const bool has_scan = std::any_of(first, last, is_of_scan);
  TrackedPose mean = *std::find_if(
      first, last, [&](const TrackedPose& pose) { return pose.is_of_scan == has_scan; });
  const Pose2 T_first_lpm = mean.T_lpm_robot.inverse();
  Vector2d offset_m = Vector2d::Zero();  // of all from the first of them
  double turn_rad = 0.0;
  double further_m = 0.0;
  double count = 0.0;
  for (auto pose = first; pose != last; ++pose) {
    if (pose->is_of_scan == has_scan) {
      const Pose2 T_first_pose = T_first_lpm * pose->T_lpm_robot;
      offset_m += T_first_pose.translation();
      turn_rad += T_first_pose.theta();
      further_m += pose->travel_m - mean.travel_m;
      count += 1.0;
    }
  }
  mean.T_lpm_robot =
      mean.T_lpm_robot * Pose2(offset_m.x() / count, offset_m.y() / count, turn_rad / count);
  mean.travel_m += further_m / count;
  mean.sharing = static_cast<int>(end - begin);
  return mean;
}

/// The local layer with a clock around its stages.
class Runner {
 public:
  Runner(const LocalmapSetup& setup, LocalmapRun* run)
      : run_(run),
        compensates_motion_(setup.compensates_motion),
        joiner_(setup.options.service.joiner),
        mapper_(setup.options.service.lpm) {}

  void take(LaserScan scan) {
    scan.sweep_duration_s = compensates_motion_ ? scan.sweep_duration_s : 0.0;
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
    run_->renewals = mapper_.renewals();
    run_->scan_lag_s = mapper_.scan_lag_s();
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
      keep_walls(joined.scan, run_->track.back().T_lpm_robot);
    }
  }

  void keep_pose(const JoinedScan& joined, const LocalFix& fix) {
    const std::vector<OdometrySample> between = between_.take(fix.time, joined.T_odom_robot);
    TrackedPose here{seconds_of(fix.time), fix.T_lpm_robot, 0.0};
    if (!run_->track.empty()) {
      const TrackedPose& last = run_->track.back();
      // As dead reckoning has it, which walls may correct.
      here.T_lpm_robot = last.T_lpm_robot * fix.motion.mean;
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
      run_->poses.push_back({seconds_of(between[i].time), bent[i + 1], here.travel_m, false});
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
  bool compensates_motion_;
  ScanJoiner joiner_;
  BetweenScans between_;
  LocalMapper mapper_;
  double mark_s_ = 0.0;
  double other_s_ = 0.0;
};

}  // namespace

std::vector<TrackedPose> one_pose_per_stamp(std::vector<TrackedPose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const TrackedPose& a, const TrackedPose& b) { return a.time_s < b.time_s; });
  std::vector<TrackedPose> single;
  for (std::size_t begin = 0; begin < poses.size();) {
    std::size_t end = begin + 1;
    while (end < poses.size() && poses[end].time_s == poses[begin].time_s) {
      ++end;  // stamps are whole microseconds
    }
    single.push_back(end == begin + 1 ? poses[begin] : mean_pose(poses, begin, end));
    begin = end;
  }
  return single;
}

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
    throw Failure(ExitCode::kConfiguration, config_file + ": cannot be read");
  }
  const Result<DaemonOptions> options = read_options(text.str());
  if (!options) {
    throw Failure(ExitCode::kConfiguration, config_file + ": " + options.error().message);
  }
  return *options;
}

namespace {

void count_inputs(const Inlets& inlets, LocalmapRun* run) {
  for (const auto& [channel, counters] : inlets.counters()) {
    const std::int64_t refused = counters.refused + counters.malformed + counters.unknown_type;
    run->refused_messages += refused;
    run->laser_changes += counters.laser_changes;
    if (refused > 0) {
      run->last_refusal = channel + ": " + counters.last_refusal;
    }
  }
}

}  // namespace

LocalmapRun run_localmap(const std::string& log, const LocalmapSetup& setup) {
  LocalmapRun run;
  Runner runner(setup, &run);
  run.damage = feed_log(
      log, setup.options,
      {[&](LaserScan scan) { runner.take(std::move(scan)); },
       [&](const OdometrySample& sample) { runner.take(sample); }, [&] { runner.start_clock(); },
       [&] { runner.stop_clock(); }, [&](const Inlets& inlets) { count_inputs(inlets, &run); }});
  runner.start_clock();
  runner.finish();
  if (run.track.empty()) {
    refuse_without_scans(log, run.damage.empty() ? run.last_refusal : run.damage);
  }
  run.poses = one_pose_per_stamp(std::move(run.poses));
  return run;
}

}  // namespace cairn::lab
