#include <cmath>

#include <benchmark/benchmark.h>

#include "layout/place_layout.hpp"
#include "layout/shared_layouts.hpp"
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

using Travels = std::vector<TravelConstraint>;

/// An arrival in 64 hypotheses that have their past in common: so many per cent of
/// them take the robot to a place that is known, about where dead reckoning says; the rest to a new
/// one.
struct Arrivals {
  int places = 0;
  Travels past;
  std::vector<Travels> hypotheses;

  [[nodiscard]] int place_count(const Travels& travels) const {
    return travels.back().to == places ? places + 1 : places;
  }
};

Arrivals arrivals(int places, int closing_percent) {
  constexpr int kHypotheses = 64;
  test::TourOptions options;
  options.place_count = places;
  Arrivals all{places, test::simulated_tour(options).travels, {}};
  const Result<PlaceLayout> layout = solve_layout(places, all.past);
  const int at = all.past.back().to;
  const auto T_global = [&](int place) {
    return layout->T_global_place[static_cast<std::size_t>(place)];
  };
  for (int i = 0; i < kHypotheses; ++i) {
    const bool closes = i * 100 < closing_percent * kHypotheses;
    const int known = (37 * i) % places;
    TravelConstraint arrival = all.past.back();
    arrival.from = at;
    arrival.to = closes ? known : places;
    arrival.T_from_to.mean = T_global(at).inverse() * T_global(known) * Pose2(0.1, 0.05, 0.01);
    all.hypotheses.push_back(all.past);
    all.hypotheses.back().push_back(arrival);
  }
  return all;
}

void lay_out_an_arrival_each_anew(benchmark::State& state) {
  const Arrivals all = arrivals(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) {
    for (const Travels& one : all.hypotheses) {
      benchmark::DoNotOptimize(solve_layout(all.place_count(one), one));
    }
  }
}
BENCHMARK(lay_out_an_arrival_each_anew)
    ->ArgsProduct({{100, 1000}, {0, 10, 50}})
    ->Unit(benchmark::kMillisecond);

void lay_out_an_arrival_shared(benchmark::State& state) {
  const Arrivals all = arrivals(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  SharedLayouts before({});
  benchmark::DoNotOptimize(before.lay_out(all.places, all.past));
  for (auto _ : state) {
    state.PauseTiming();
    SharedLayouts layouts = before;
    state.ResumeTiming();
    for (const Travels& one : all.hypotheses) {
      benchmark::DoNotOptimize(layouts.lay_out(all.place_count(one), one));
    }
  }
}
BENCHMARK(lay_out_an_arrival_shared)
    ->ArgsProduct({{100, 1000}, {0, 10, 50}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
