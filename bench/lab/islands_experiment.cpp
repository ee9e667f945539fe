#include "bench/lab/islands_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "bench/lab/resources.hpp"
#include "clients/common/progress.hpp"
#include "clients/sim/laser.hpp"
#include "lpm/scan_matcher.hpp"

namespace cairn::lab {
namespace {

constexpr int kScansOfMap = 6;

LaserScan scan_at(const sim::World& world, const Pose2& T_world_robot, sim::Laser* laser) {
  const sim::Pose pose{{T_world_robot.x(), T_world_robot.y()}, T_world_robot.theta()};
  LaserScan scan;
  scan.max_range_m = laser->max_range_m();
  scan.ranges_m = laser->sweep(world.plan, pose);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    scan.bearings_rad.push_back(static_cast<float>(
        laser->first_bearing_rad() + static_cast<double>(i) * laser->bearing_step_rad()));
  }
  return scan;
}

sim::LaserOptions all_around() {
  sim::LaserOptions options;
  options.fov_deg = 360.0;
  return options;
}

/// One pose after the other, with one laser and one source of chance.
class PoseTrial {
 public:
  PoseTrial(const sim::World& world, const IslandsOptions& options)
      : world_(world),
        options_(options),
        laser_(all_around(), options.seed),
        random_(static_cast<std::mt19937::result_type>(options.seed)) {}

  TriedPose at(const Vector2d& p_world) {
    ScrollingMap map(lpm_.map);
    for (int i = 0; i < kScansOfMap; ++i) {
      const Pose2 T_world_robot(p_world, 2.0 * kPi * i / kScansOfMap);
      map.insert(scan_at(world_, T_world_robot, &laser_), T_world_robot, 0.0);
    }
    TriedPose tried;
    tried.p_world = p_world;
    LocalViewer viewer;
    const LocalView view = viewer.look_around(map.grid(), p_world, place_, place_.min_corner_rad);
    const double start_s = cpu_time_s();
    tried.island = island_at(view, p_world);
    measure_s_ += cpu_time_s() - start_s;
    for (int i = 0; i < options_.starts; ++i) {
      find_again(map, &tried);
    }
    return tried;
  }

  [[nodiscard]] double measure_s() const { return measure_s_; }

 private:
  /// Uniform in [-1, 1], the same on every machine.
  double chance() { return 2.0 * static_cast<double>(random_()) / 4294967295.0 - 1.0; }

  void find_again(const ScrollingMap& map, TriedPose* tried) {
    const Pose2 truth(tried->p_world, kPi * chance());
    const double x_m = truth.x() + options_.offset_m * chance();
    const double y_m = truth.y() + options_.offset_m * chance();
    const Pose2 start(x_m, y_m, truth.theta() + options_.turn_rad * chance());
    // Of uniform offsets, and of some doubt at least.
    const double variance_m2 = std::max(1e-4, options_.offset_m * options_.offset_m / 3.0);
    const double variance_rad2 = std::max(1e-4, options_.turn_rad * options_.turn_rad / 3.0);
    const Matrix3d covariance =
        Eigen::Vector3d(variance_m2, variance_m2, variance_rad2).asDiagonal();
    ScanBeams beams;
    beams.take(scan_at(world_, truth, &laser_), {}, lpm_.map.max_free_range_m);
    ScanMatcher matcher(lpm_.match);
    matcher.take(beams);
    const Pose2 found =
        matcher.is_blocked() ? start : matcher.match(map, {start, covariance}).fit.T_lpm_robot;
    const double share = 1.0 / options_.starts;
    tried->error_m += share * (found.translation() - truth.translation()).norm();
    tried->error_rad += share * std::abs(turn_between(found.theta(), truth.theta()));
  }

  const sim::World& world_;
  const IslandsOptions& options_;
  sim::Laser laser_;
  std::mt19937 random_;
  LpmOptions lpm_;
  PlaceOptions place_;
  double measure_s_ = 0.0;
};

std::vector<Vector2d> poses_of(const sim::World& world, const IslandsOptions& options) {
  const double width_m = world.plan.columns() * world.plan.cell_m();
  const double height_m = world.plan.rows() * world.plan.cell_m();
  std::vector<Vector2d> poses;
  for (double y = 0.5 * options.spacing_m; y < height_m; y += options.spacing_m) {
    for (double x = 0.5 * options.spacing_m; x < width_m; x += options.spacing_m) {
      if (sim::clearance_m(world.plan, {x, y}, options.clearance_m) >= options.clearance_m) {
        poses.emplace_back(x, y);
      }
    }
  }
  return poses;
}

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) {
      ++end;
    }
    for (std::size_t i = begin; i < end; ++i) {
      ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    }
    begin = end;
  }
  return ranks;
}

}  // namespace

double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2) {
    return 0.0;
  }
  const std::vector<double> x = ranks_of(a);
  const std::vector<double> y = ranks_of(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

IslandsRun run_islands(const sim::World& world, const IslandsOptions& options) {
  const std::vector<Vector2d> poses = poses_of(world, options);
  PoseTrial trial(world, options);
  IslandsRun run;
  std::vector<double> measures;
  std::vector<double> errors;
  clients::Progress progress("trying poses");
  for (const Vector2d& p_world : poses) {
    run.poses.push_back(trial.at(p_world));
    measures.push_back(run.poses.back().island.distinctiveness);
    errors.push_back(run.poses.back().error_m);
    progress.show(static_cast<std::int64_t>(run.poses.size()),
                  static_cast<std::int64_t>(poses.size()));
  }
  run.rank_correlation = spearman(measures, errors);
  run.us_per_measure =
      poses.empty() ? 0.0 : 1e6 * trial.measure_s() / static_cast<double>(poses.size());
  return run;
}

}  // namespace cairn::lab
