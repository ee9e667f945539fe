#include <algorithm>
#include <cstdlib>

#include <benchmark/benchmark.h>

#include "place/neighbourhood.hpp"

namespace cairn {
namespace {

/// Corridors 2 m wide that cross every 10 m, walls one cell thick, unknown beyond.
OccupancyGrid lattice(double side_m) {
  GridGeometry geometry;
  geometry.cell_m = 0.05;
  geometry.width = geometry.height = static_cast<int>(side_m / geometry.cell_m);
  OccupancyGrid grid(geometry);
  const auto distance_to_axis = [](int cell) { return std::abs((cell + 100) % 200 - 100); };
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const int nearest = std::min(distance_to_axis(x), distance_to_axis(y));
      if (nearest <= 21) {
        grid.log_odds({x, y}) =
            nearest <= 20 ? OccupancyGrid::LogOdds{-300} : OccupancyGrid::LogOdds{300};
      }
    }
  }
  return grid;
}

/// Looks at 10 m x 10 m in cells of 5 cm: 200 x 200 cells.
PlaceOptions fine_look() {
  PlaceOptions options;
  options.window_m = 10.0;
  options.cell_m = 0.05;
  return options;
}

void find_places_around_a_crossing(benchmark::State& state) {
  const OccupancyGrid grid = lattice(40.0);
  const PlaceOptions options;
  for (auto _ : state) {
    benchmark::DoNotOptimize(find_places(grid, {20.0, 20.0}, options));
  }
}
BENCHMARK(find_places_around_a_crossing)->Unit(benchmark::kMillisecond);

void axis_and_gateways_of_10_m_from_scratch(benchmark::State& state) {
  const OccupancyGrid grid = lattice(40.0);
  const PlaceOptions options = fine_look();
  for (auto _ : state) {
    benchmark::DoNotOptimize(find_places(grid, {20.0, 20.0}, options));
  }
}
BENCHMARK(axis_and_gateways_of_10_m_from_scratch)->Unit(benchmark::kMillisecond);

/// From look to look the robot drives on by 5 cm, and a stretch of wall comes or goes.
void axis_and_gateways_of_10_m_followed(benchmark::State& state) {
  OccupancyGrid grid = lattice(40.0);
  const PlaceOptions options = fine_look();
  LocalViewer viewer;
  int look = 0;
  for (auto _ : state) {
    ++look;
    const OccupancyGrid::LogOdds wall = look % 2 == 0 ? -300 : 300;
    for (int x = 420; x < 425; ++x) {
      grid.log_odds({x, 418}) = wall;
    }
    const Vector2d robot(20.0 + 0.05 * (look % 20), 20.0);
    benchmark::DoNotOptimize(find_places(grid, robot, options, {}, &viewer));
  }
}
BENCHMARK(axis_and_gateways_of_10_m_followed)->Unit(benchmark::kMillisecond);
/// Where corridors meet: most rays are long there.
void distinctiveness_at_a_crossing(benchmark::State& state) {
  LocalViewer viewer;
  const LocalView view = viewer.look_around(lattice(40.0), {20.0, 20.0}, PlaceOptions{}, 0.6);
  for (auto _ : state) {
    benchmark::DoNotOptimize(island_at(view, {20.0, 20.0}));
  }
}
BENCHMARK(distinctiveness_at_a_crossing)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
