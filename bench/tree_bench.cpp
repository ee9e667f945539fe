// The tree of topological maps: how fast it grows, and what it holds.

#include <optional>

#include <benchmark/benchmark.h>

#include "support/lattice.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {
namespace {

TopologyOptions all_hypotheses() {
  TopologyOptions options;
  options.max_hypotheses = 10'000'000;
  options.max_bytes = 100'000'000'000;
  return options;
}

HypothesisTree explored(const test::Walk& walk, const TopologyOptions& options) {
  HypothesisTree tree(options);
  benchmark::DoNotOptimize(tree.start(walk.start).ok());
  for (const test::Experienced& step : walk.steps) {
    benchmark::DoNotOptimize(tree.extend(step.action, step.view).ok());
  }
  return tree;
}

void report(const HypothesisTree& tree, std::int64_t nodes, benchmark::State& state) {
  state.SetItemsProcessed(nodes);
  state.counters["nodes_stored"] = static_cast<double>(tree.memory().nodes);
}

/// Every map of the 4 x 4 snake: planar or not, with at most this many places (0: any number).
void BM_AllMapsOf4x4(benchmark::State& state) {
  const test::Lattice streets(4, 4);
  const test::Walk walk = streets.walk(0, test::snake_moves(4, 4));
  TopologyOptions options = all_hypotheses();
  options.planar = state.range(0) != 0;
  if (state.range(1) > 0) {
    options.max_places = static_cast<int>(state.range(1));
  }
  std::int64_t nodes = 0;
  std::optional<HypothesisTree> tree;
  for (auto _ : state) {
    tree.emplace(explored(walk, options));
    nodes += tree->node_count();
  }
  report(*tree, nodes, state);
  const HypothesisTree::Memory memory = tree->memory();
  state.counters["bytes_per_node"] =
      static_cast<double>(memory.bytes_held_for_nodes) / static_cast<double>(memory.nodes);
}
BENCHMARK(BM_AllMapsOf4x4)
    ->ArgNames({"planar", "places"})
    ->Args({1, 16})
    ->Args({0, 16})
    ->Args({1, 0})
    ->Args({0, 0})
    ->Unit(benchmark::kMillisecond);

/// The best thousand maps of the snake through a square lattice.
void BM_BestThousand(benchmark::State& state) {
  const auto side = static_cast<int>(state.range(0));
  const test::Lattice streets(side, side);
  const test::Walk walk = streets.walk(0, test::snake_moves(side, side));
  TopologyOptions options;
  options.max_hypotheses = 1000;
  std::int64_t nodes = 0;
  std::optional<HypothesisTree> tree;
  for (auto _ : state) {
    tree.emplace(explored(walk, options));
    nodes += tree->node_count();
  }
  report(*tree, nodes, state);
  state.counters["places"] = side * side;
}
BENCHMARK(BM_BestThousand)->Arg(4)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
