#include <algorithm>
#include <cstdlib>

#include <benchmark/benchmark.h>

#include "grid/medial_axis.hpp"
#include "region/region_graph.hpp"

namespace cairn {
namespace {

/// A floor of 763 x 708 cells of 5 cm: corridors 2 m wide every 12 m, rooms of 4.6 m with doors of
/// 1 m between them.
OccupancyGrid floor_of_rooms() {
  GridGeometry geometry;
  geometry.width = 763;
  geometry.height = 708;
  OccupancyGrid grid(geometry);
  const auto is_wall = [](int along, int across) {
    const int in_block = across % 240;
    if (in_block >= 200) {
      return in_block == 200 || in_block == 239;  // A corridor.
    }
    return in_block % 100 < 3 || along % 95 < 3;
  };
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const bool is_door = (x % 95 >= 30 && x % 95 < 50) && y > 3 && y + 4 < geometry.height;
      const bool is_border = std::min({x, y, geometry.width - 1 - x, geometry.height - 1 - y}) < 3;
      grid.log_odds({x, y}) = is_border || (is_wall(x, y) && !is_door) ? 300 : -300;
    }
  }
  return grid;
}

void distance_transform_of_763_x_708_cells(benchmark::State& state) {
  const OccupancyGrid grid = floor_of_rooms();
  for (auto _ : state) {
    benchmark::DoNotOptimize(distance_transform(grid));
  }
}
BENCHMARK(distance_transform_of_763_x_708_cells)->Unit(benchmark::kMillisecond);

void medial_axis_of_763_x_708_cells(benchmark::State& state) {
  const OccupancyGrid grid = floor_of_rooms();
  for (auto _ : state) {
    benchmark::DoNotOptimize(medial_axis(distance_transform(grid), {50, 50}, MedialAxisOptions{}));
  }
}
BENCHMARK(medial_axis_of_763_x_708_cells)->Unit(benchmark::kMillisecond);

void region_graph_of_763_x_708_cells(benchmark::State& state) {
  const OccupancyGrid grid = floor_of_rooms();
  for (auto _ : state) {
    benchmark::DoNotOptimize(region_graph(grid, RegionOptions{}));
  }
}
BENCHMARK(region_graph_of_763_x_708_cells)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
