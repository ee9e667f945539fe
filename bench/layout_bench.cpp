#include <cmath>

#include <benchmark/benchmark.h>

#include "layout/place_layout.hpp"
#include "support/simulated_tour.hpp"

namespace cairn {
namespace {

/// Places in a ring, one closure, every displacement a little wrong.
std::vector<TravelConstraint> ring(int places) {
  std::vector<TravelConstraint> travels;
  const double turn_rad = 2.0 * kPi / places;
  for (int i = 0; i < places; ++i) {
    const double wrong_m = 0.05 * std::sin(7.0 * i);
    const Matrix3d covariance = Eigen::Vector3d(0.01, 0.01, 0.0004).asDiagonal();
    travels.push_back({i,
                       (i + 1) % places,
                       {Pose2(5.0 + wrong_m, wrong_m, turn_rad + 0.1 * wrong_m), covariance}});
  }
  return travels;
}

void solve_layout_of_a_ring(benchmark::State& state) {
  const int places = static_cast<int>(state.range(0));
  const std::vector<TravelConstraint> travels = ring(places);
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve_layout(places, travels));
  }
  state.SetComplexityN(places);
}
BENCHMARK(solve_layout_of_a_ring)->RangeMultiplier(4)->Range(16, 4096)->Complexity();

/// A wanderer's tour; the share of travels that close a loop is counted.
void solve_layout_of_a_tour(benchmark::State& state) {
  test::TourOptions options;
  options.place_count = static_cast<int>(state.range(0));
  options.preference = 0.01 * static_cast<double>(state.range(1));
  const test::SimulatedTour tour = test::simulated_tour(options);
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve_layout(options.place_count, tour.travels));
  }
  state.counters["travels"] = static_cast<double>(tour.travels.size());
}
BENCHMARK(solve_layout_of_a_tour)
    ->ArgsProduct({{100, 1000, 10000}, {90, 50, 10}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
