#include "bench/lab/run_breadth.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "bench/lab/resources.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/paths.hpp"
#include "topology/regions.hpp"

namespace cairn::lab {
namespace {

TopologyOptions strict(const ExactSearchOptions& options) {
  TopologyOptions strict;
  strict.planar = options.planar;
  strict.region_consistent = options.region_consistent;
  strict.max_places = options.max_places;
  strict.max_hypotheses = 10'000'000;
  strict.max_bytes = 1'000'000'000'000;
  return strict;
}

/// Codes of the simplest maps of a kind.
template <typename Simplest>
bool is_simplest(const TopologicalMap& map, std::optional<Simplest>* simplest) {
  const std::pair simplicity(map.path_count(), map.place_count());
  if (!*simplest || simplicity < std::pair((*simplest)->paths, (*simplest)->places)) {
    simplest->emplace();
    (*simplest)->paths = simplicity.first;
    (*simplest)->places = simplicity.second;
  }
  return simplicity == std::pair((*simplest)->paths, (*simplest)->places);
}

void count_final(const TopologicalMap& map, MapCounts& counts) {
  ++counts.final_maps;
  const bool is_closed_paper = map.has_no_lone_path();
  counts.closed_paper += is_closed_paper ? 1 : 0;
  counts.closed_no_pending += map.is_closed() ? 1 : 0;
  counts.perpendicular_closed_paper += is_closed_paper && is_perpendicular(map) ? 1 : 0;
  if (!is_region_consistent(map)) {
    return;
  }
  ++counts.region_consistent_finals;
  if (map.is_closed() && is_simplest(map, &counts.optimal)) {
    ++counts.optimal->count;
    counts.optimal->codes.push_back(canonical_code(map));
  }
  if (is_simplest(map, &counts.minimal_region)) {
    ++counts.minimal_region->count;
    if (!has_triangle(map)) {
      ++counts.minimal_region->count_without_triangles;
      counts.minimal_region->codes.push_back(canonical_code(map));
    }
  }
}

/// As enumerate() gives them: sorted, and none where there are too many.
template <typename Simplest>
void tidy(std::size_t max_codes, std::optional<Simplest>* simplest) {
  if (*simplest) {
    std::vector<std::string>& codes = (*simplest)->codes;
    std::sort(codes.begin(), codes.end());
    if (codes.size() > max_codes) {
      codes.clear();
    }
  }
}

/// Maps that are not region-consistent never heal, so those left by pruning are those that are.
std::vector<std::int64_t> region_leaves(const Exploration& exploration,
                                        ExactSearchOptions options,
                                        const std::vector<std::int64_t>& leaves) {
  if (options.region_consistent) {
    return leaves;
  }
  options.region_consistent = true;
  HypothesisTree tree(strict(options));
  CAIRN_CHECK(tree.start({exploration.start, exploration.start_gateway, VisitId{0}}).ok());
  std::vector<std::int64_t> left;
  for (std::size_t step = 0; step < leaves.size(); ++step) {
    const ExplorationStep& next = exploration.steps[step];
    const auto report =
        tree.extend({next.turn}, {next.star, next.arrival_gateway, VisitId{tree.visit_count()}});
    CAIRN_CHECK(report.ok());
    left.push_back(report->leaves);
  }
  return left;
}

}  // namespace

SearchRun run_breadth(const Exploration& exploration, const ExactSearchOptions& options) {
  const double start_s = cpu_time_s();
  SearchRun run;
  MapCounts& counts = run.counts;
  HypothesisTree tree(strict(options));
  CAIRN_CHECK(tree.start({exploration.start, exploration.start_gateway, VisitId{0}}).ok());
  for (const ExplorationStep& step : exploration.steps) {
    const Result<ExtendReport> report =
        tree.extend({step.turn}, {step.star, step.arrival_gateway, VisitId{tree.visit_count()}});
    CAIRN_CHECK(report.ok());
    counts.view_mismatches += report->links_contradicted;
    counts.leaves_per_step.push_back(report->leaves);
    run.is_complete = !report->guarantee_given_up && report->waiting == 0;
    if (!run.is_complete || (options.max_nodes > 0 && tree.node_count() >= options.max_nodes)) {
      run.is_complete = false;
      break;
    }
  }
  counts.tree_nodes = tree.node_count();
  counts.maps_built = tree.maps_built();
  const HypothesisTree::Memory memory = tree.memory();
  run.bytes_per_node = memory.bytes_of_nodes / memory.nodes;
  run.cpu_s = cpu_time_s() - start_s;
  counts.region_leaves_per_step = region_leaves(exploration, options, counts.leaves_per_step);
  // Looking at every map afterwards is not part of the search.
  const auto max_codes = static_cast<std::size_t>(options.max_codes);
  tree.for_each_map(
      [&](const Hypothesis&, const TopologicalMap& map) { count_final(map, counts); });
  tidy(max_codes, &counts.optimal);
  tidy(max_codes, &counts.minimal_region);
  return run;
}

}  // namespace cairn::lab
