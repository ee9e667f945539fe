#include "bench/lab/search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/lab/resources.hpp"
#include "bench/lab/run_breadth.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

/// @pre the search reached max_nodes
std::string given_up(const ExactSearchOptions& options) {
  return "given up after " + grouped(options.max_nodes) +
         " nodes (--max-nodes): the search needs more";
}

SearchRun run_depth(const Exploration& exploration, const ExactSearchOptions& options) {
  Enumeration all = enumerate(exploration, options);
  SearchRun run;
  run.counts = std::move(all.counts);
  run.given_up = all.is_complete ? "" : given_up(options);
  return run;
}

SearchRun run_best(const Exploration& exploration,
                   const ExactSearchOptions& options,
                   SearchOrder order) {
  const BestMap best = find_best(exploration, options, order);
  SearchRun run;
  run.is_best_first = true;
  run.counts.tree_nodes = best.tree_nodes;
  run.counts.maps_built = best.maps_built;
  run.given_up = best.is_complete ? "" : given_up(options);
  run.is_proven = best.is_proven;
  run.max_open = best.max_open;
  run.bytes_per_node = best.bytes_per_node;
  if (best.map) {
    run.best_code = best.code;
    run.counts.optimal =
        SimplestMaps{1, best.map->path_count(), best.map->place_count(), {best.code}};
  }
  return run;
}

}  // namespace

SearchRun run_search(SearchKind kind,
                     const Exploration& exploration,
                     const ExactSearchOptions& options,
                     SearchOrder order) {
  const double start_s = cpu_time_s();
  SearchRun run;
  switch (kind) {
    case SearchKind::kBreadth:
      return run_breadth(exploration, options);
    case SearchKind::kDepth:
      run = run_depth(exploration, options);
      break;
    case SearchKind::kBest:
      run = run_best(exploration, options, order);
      break;
  }
  run.cpu_s = cpu_time_s() - start_s;
  return run;
}

std::int64_t nodes_per_s(const SearchRun& run) {
  return std::llround(static_cast<double>(run.counts.tree_nodes) / std::max(run.cpu_s, 1e-9));
}

double milliseconds(double seconds) {
  return std::round(1e6 * seconds) / 1e3;
}

std::string cost_text(const SearchRun& run) {
  const std::int64_t rounded = (nodes_per_s(run) + 500) / 1000 * 1000;
  std::string text = grouped(run.counts.tree_nodes) + " nodes in " +
                     clients::fixed(1000.0 * run.cpu_s, run.cpu_s < 0.1 ? 2 : 0) +
                     " ms of CPU time (" + grouped(rounded) + " nodes/s), ";
  text += run.bytes_per_node == 0 ? "none stored"
                                  : std::to_string(run.bytes_per_node) + " bytes per stored node";
  return text + ", peak memory " + clients::byte_size(peak_resident_bytes());
}

}  // namespace cairn::lab
