// The global map of a building of 200 m x 200 m: from scratch, after a closure that moves half of
// it, and for one more scan.

#include "global_map/global_map.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

namespace cairn {
namespace {

constexpr double kBlock_m = 20.0;  // from corridor to corridor
constexpr double kHalfWide_m = 1.25;
constexpr int kBlocks = 10;
constexpr double kStep_m = 0.3;  // between scans
constexpr int kBeams = 360;
constexpr double kRange_m = 12.0;

/// Distance to the walls of a lattice of corridors, from within one.
double range_in_lattice(const Vector2d& from, double bearing_rad) {
  const Vector2d way(std::cos(bearing_rad), std::sin(bearing_rad));
  const auto is_corridor = [](double v) {
    return std::abs(v - kBlock_m * std::round(v / kBlock_m)) < kHalfWide_m;
  };
  constexpr double kMarch_m = 0.02;
  for (double range_m = kMarch_m; range_m < kRange_m; range_m += kMarch_m) {
    const Vector2d p = from + range_m * way;
    if (!is_corridor(p.x()) && !is_corridor(p.y())) {
      return range_m;
    }
  }
  return std::numeric_limits<double>::infinity();
}

LaserScan scan_at(const Pose2& pose) {
  LaserScan scan;
  scan.max_range_m = kRange_m;
  for (int i = 0; i < kBeams; ++i) {
    const double bearing_rad = 2.0 * kPi * i / kBeams - kPi;
    scan.bearings_rad.push_back(static_cast<float>(bearing_rad));
    scan.ranges_m.push_back(
        static_cast<float>(range_in_lattice(pose.translation(), pose.theta() + bearing_rad)));
  }
  return scan;
}

/// Along every corridor once: 14,674 scans on 4.4 km.
const std::vector<PosedScan>& tour() {
  static const std::vector<PosedScan> scans = [] {
    std::vector<PosedScan> all;
    for (int corridor = 0; corridor <= kBlocks; ++corridor) {
      for (const bool is_east : {true, false}) {
        for (double along_m = 0.0; along_m <= kBlocks * kBlock_m; along_m += kStep_m) {
          const double across_m = corridor * kBlock_m;
          const Pose2 pose =
              is_east ? Pose2(along_m, across_m, 0.0) : Pose2(across_m, along_m, 0.5 * kPi);
          all.push_back({std::make_shared<const LaserScan>(scan_at(pose)), pose});
        }
      }
    }
    return all;
  }();
  return scans;
}

/// A closure turns and shifts the second half.
std::vector<PosedScan> half_moved() {
  std::vector<PosedScan> moved = tour();
  const Pose2 T_new_old(0.3, -0.2, 0.01);
  for (std::size_t i = moved.size() / 2; i < moved.size(); ++i) {
    moved[i].T_global_robot = T_new_old * moved[i].T_global_robot;
  }
  return moved;
}

void draw_from_scratch(benchmark::State& state) {
  for (auto _ : state) {
    GlobalMap map;
    benchmark::DoNotOptimize(map.draw(tour()));
    state.counters["tiles"] = static_cast<double>(map.tiles().size());
  }
  state.counters["scans"] = static_cast<double>(tour().size());
}
BENCHMARK(draw_from_scratch)->Unit(benchmark::kMillisecond);

void redraw_half_after_a_closure(benchmark::State& state) {
  const std::vector<PosedScan> moved = half_moved();
  GlobalMap map;
  static_cast<void>(map.draw(tour()));
  bool is_moved = false;
  for (auto _ : state) {
    is_moved = !is_moved;
    const std::vector<TileIndex> changed = map.draw(is_moved ? moved : tour());
    for (const TileIndex& tile : changed) {
      benchmark::DoNotOptimize(map.percent_of(tile));
    }
    state.counters["tiles"] = static_cast<double>(changed.size());
  }
}
BENCHMARK(redraw_half_after_a_closure)->Unit(benchmark::kMillisecond);

void draw_one_more_scan(benchmark::State& state) {
  GlobalMap map;
  std::vector<PosedScan> scans(tour().begin(), tour().begin() + 12'000);
  static_cast<void>(map.draw(scans));
  std::size_t next = scans.size();
  for (auto _ : state) {
    state.PauseTiming();
    scans.push_back(tour()[next++ % tour().size()]);
    state.ResumeTiming();
    const std::vector<TileIndex> changed = map.draw(scans);
    for (const TileIndex& tile : changed) {
      benchmark::DoNotOptimize(map.percent_of(tile));
    }
    state.counters["tiles"] = static_cast<double>(changed.size());
  }
}
BENCHMARK(draw_one_more_scan)->Unit(benchmark::kMicrosecond)->Iterations(200);

}  // namespace
}  // namespace cairn
