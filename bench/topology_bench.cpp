// Nodes per second are the figure to look at; the tree of a row never changes.

#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "exact_search/exact_search.hpp"
#include "exact_search/observed_walk.hpp"
#include "support/explorations.hpp"
#include "topology/working_map.hpp"

namespace cairn {
namespace {

void count_nodes(benchmark::State& state, std::int64_t nodes) {
  state.counters["nodes"] = static_cast<double>(nodes);
  state.counters["nodes_per_s"] =
      benchmark::Counter(static_cast<double>(nodes), benchmark::Counter::kIsIterationInvariantRate);
}

// --- Enumeration of a whole tree, rows x columns, with or without planarity.

void enumerate_a_grid(benchmark::State& state, bool planar, int max_places) {
  const Exploration grid =
      test::snake(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  ExactSearchOptions options;
  options.planar = planar;
  if (max_places > 0) {
    options.max_places = max_places;
  }
  std::int64_t nodes = 0;
  for (auto _ : state) {
    nodes = enumerate(grid, options).counts.tree_nodes;
  }
  count_nodes(state, nodes);
}
void enumerate_planar(benchmark::State& state) {
  enumerate_a_grid(state, true, 0);
}
void enumerate_nonplanar(benchmark::State& state) {
  enumerate_a_grid(state, false, 0);
}
void enumerate_16_places_planar(benchmark::State& state) {
  enumerate_a_grid(state, true, 16);
}
void enumerate_16_places_nonplanar(benchmark::State& state) {
  enumerate_a_grid(state, false, 16);
}
BENCHMARK(enumerate_planar)
    ->Args({3, 4})
    ->Args({4, 4})
    ->Args({4, 5})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(enumerate_nonplanar)->Args({3, 4})->Args({4, 4})->Unit(benchmark::kMillisecond);
BENCHMARK(enumerate_16_places_planar)->Args({4, 4})->Unit(benchmark::kMillisecond);
BENCHMARK(enumerate_16_places_nonplanar)->Args({4, 4})->Unit(benchmark::kMillisecond);

// --- The only closed map of a square grid with four corners: side.

void enumerate_four_corners(benchmark::State& state, bool compass, bool by_face) {
  const auto side = static_cast<int>(state.range(0));
  const Exploration grid = test::snake(side, side);
  ExactSearchOptions options;
  options.planar = options.perpendicular = options.look_ahead = true;
  options.max_corners = 4;
  options.compass = compass;
  options.look_ahead_by_face = by_face;
  std::int64_t nodes = 0;
  for (auto _ : state) {
    nodes = enumerate(grid, options).counts.tree_nodes;
  }
  count_nodes(state, nodes);
}
void enumerate_at_most_four_corners(benchmark::State& state) {
  enumerate_four_corners(state, false, false);
}
void enumerate_at_most_four_corners_by_compass(benchmark::State& state) {
  enumerate_four_corners(state, true, false);
}
void enumerate_at_most_four_corners_by_face(benchmark::State& state) {
  enumerate_four_corners(state, false, true);
}
BENCHMARK(enumerate_at_most_four_corners_by_face)
    ->Arg(6)
    ->Arg(8)
    ->Arg(9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(enumerate_at_most_four_corners)->Arg(6)->Arg(9)->Arg(13)->Unit(benchmark::kMillisecond);
BENCHMARK(enumerate_at_most_four_corners_by_compass)
    ->Arg(10)
    ->Arg(15)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);

// --- Best-first: side of the grid.

void find_best_grid(benchmark::State& state, SearchOrder order, bool perpendicular) {
  const auto side = static_cast<int>(state.range(0));
  const Exploration grid = test::snake(side, side);
  ExactSearchOptions options;
  options.planar = true;
  options.perpendicular = perpendicular;
  options.region_consistent = !perpendicular;
  std::int64_t nodes = 0;
  for (auto _ : state) {
    nodes = find_best(grid, options, order).tree_nodes;
  }
  count_nodes(state, nodes);
}
void find_fewest_places_by_regions(benchmark::State& state) {
  find_best_grid(state, SearchOrder::kPlaces, false);
}
void find_fewest_places(benchmark::State& state) {
  find_best_grid(state, SearchOrder::kPlaces, true);
}
void find_fewest_paths_with_corners(benchmark::State& state) {
  find_best_grid(state, SearchOrder::kPathsWithCorners, true);
}
void find_fewest_corners(benchmark::State& state) {
  find_best_grid(state, SearchOrder::kCorners, true);
}
BENCHMARK(find_fewest_places_by_regions)->Arg(4)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(find_fewest_places)->Arg(4)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(find_fewest_paths_with_corners)->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(find_fewest_corners)->Arg(6)->Arg(9)->Arg(13)->Unit(benchmark::kMillisecond);

// --- A new place, and a link, done and undone on a map of so many places.

/// Grows by places of type + only, so that gateways stay pending.
WorkingMap grown_map(const ObservedWalk& walk, int places) {
  std::mt19937 random(1);
  WorkingMap map(walk.stars(), WorkingMap::Rings::kFaces);
  map.start(walk.start(), VisitId{0});
  while (map.place_count() < places) {
    const auto at = static_cast<GatewayIndex>(random() % static_cast<unsigned>(map.end_gateway()));
    if (map.is_pending(at)) {
      map.apply({MapChange::Kind::kPlace, walk.start(), VisitId{map.place_count()}, at, 0});
    }
  }
  return map;
}

GatewayIndex first_pending(const WorkingMap& map) {
  GatewayIndex at = 0;
  while (!map.is_pending(at)) {
    ++at;
  }
  return at;
}

void do_and_undo(benchmark::State& state, bool links) {
  const ObservedWalk walk({test::Lattice(3, 3).star_at(4), 0, {}});
  WorkingMap map = grown_map(walk, static_cast<int>(state.range(0)));
  const GatewayIndex at = first_pending(map);
  const MapChange change =
      links ? MapChange{MapChange::Kind::kLink,
                        {},
                        VisitId{0},
                        at,
                        map.next_in_ring(map.next_in_ring(at))}
            : MapChange{MapChange::Kind::kPlace, walk.start(), VisitId{map.place_count()}, at, 1};
  for (auto _ : state) {
    map.apply(change);
    benchmark::DoNotOptimize(map);
    map.undo(change);
  }
}
void do_and_undo_a_place(benchmark::State& state) {
  do_and_undo(state, false);
}
void do_and_undo_a_link(benchmark::State& state) {
  do_and_undo(state, true);
}
BENCHMARK(do_and_undo_a_place)->Arg(16)->Arg(64)->Arg(256);
BENCHMARK(do_and_undo_a_link)->Arg(16)->Arg(64)->Arg(256);

}  // namespace
}  // namespace cairn
