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

void find_places_around_a_crossing(benchmark::State& state) {
  const OccupancyGrid grid = lattice(40.0);
  const PlaceOptions options;
  for (auto _ : state) {
    benchmark::DoNotOptimize(find_places(grid, {20.0, 20.0}, options));
  }
}
BENCHMARK(find_places_around_a_crossing)->Unit(benchmark::kMillisecond);

/// Where corridors meet: most rays are long there.
void distinctiveness_at_a_crossing(benchmark::State& state) {
  const LocalView view = look_around(lattice(40.0), {20.0, 20.0}, PlaceOptions{});
  for (auto _ : state) {
    benchmark::DoNotOptimize(island_at(view, {20.0, 20.0}));
  }
}
BENCHMARK(distinctiveness_at_a_crossing)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
