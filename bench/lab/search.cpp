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

double ratio(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

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

SearchRun run_best(const Exploration& exploration, ExactSearchOptions options, SearchOrder order) {
  // Perpendicular maps are region-consistent.
  options.region_consistent = !options.perpendicular;
  const BestMap best = find_best(exploration, options, order);
  SearchRun run;
  run.is_best_first = true;
  run.counts.tree_nodes = best.tree_nodes;
  run.counts.maps_built = best.maps_built;
  run.given_up = best.is_complete ? "" : given_up(options);
  run.is_proven = best.is_proven;
  run.max_open = best.max_open;
  run.stored.nodes = best.stored_nodes;
  run.stored.bytes_of_nodes = best.stored_nodes * static_cast<std::int64_t>(best.bytes_per_node);
  run.stored.leaves = best.max_open;
  run.stored.bytes_of_leaves = best.max_open * static_cast<std::int64_t>(best.bytes_per_open);
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

std::string minimised(SearchKind kind, const ExactSearchOptions& options, SearchOrder order) {
  const std::string maps =
      std::string(options.perpendicular ? "perpendicular" : "region-consistent") +
      " maps without pending gateways";
  if (kind == SearchKind::kBest && order == SearchOrder::kPlaces) {
    return "places, then paths, of " + maps;
  }
  if (kind == SearchKind::kBest && order == SearchOrder::kCorners) {
    return "corners (L), then places, of " + maps;
  }
  return "paths, then places, of " + maps;
}

double StoredTree::bytes_per_node() const {
  return ratio(bytes_of_nodes, nodes);
}

double StoredTree::bytes_per_leaf() const {
  return ratio(bytes_of_leaves, leaves);
}

double StoredTree::bytes_per_hypothesis() const {
  return ratio(bytes_of_nodes + bytes_of_leaves, leaves);
}

StoredTree& StoredTree::operator+=(const StoredTree& other) {
  nodes += other.nodes;
  bytes_of_nodes += other.bytes_of_nodes;
  leaves += other.leaves;
  bytes_of_leaves += other.bytes_of_leaves;
  return *this;
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
                     " ms of CPU time (" + grouped(rounded) + " nodes/s" +
                     (run.is_best_first || run.counting_cpu_s ? "" : ", counting included") + "), ";
  if (run.counting_cpu_s) {
    text += "then " + clients::fixed(1000.0 * *run.counting_cpu_s, 2) +
            " ms to count final maps and regions, ";
  }
  const StoredTree& stored = run.stored;
  text += stored.nodes == 0
              ? "none stored"
              : clients::fixed(stored.bytes_per_node(), 0) + " bytes per stored node, " +
                    clients::fixed(stored.bytes_per_leaf(), 0) + " per leaf, " +
                    clients::fixed(stored.bytes_per_hypothesis(), 0) +
                    " per hypothesis with its share of the nodes";
  return text + ", peak memory " + clients::byte_size(peak_resident_bytes());
}

Json cost_json(const SearchRun& run) {
  const StoredTree& stored = run.stored;
  const auto if_stored = [&stored](double bytes) {
    return stored.nodes == 0 ? Json() : Json(bytes);
  };
  return {
      {"cpu_ms", milliseconds(run.cpu_s)},
      {"counting_cpu_ms", run.counting_cpu_s ? Json(milliseconds(*run.counting_cpu_s)) : Json()},
      {"nodes_per_s", nodes_per_s(run)},
      {"stored_nodes", stored.nodes},
      {"bytes_per_stored_node", if_stored(stored.bytes_per_node())},
      {"bytes_per_leaf", if_stored(stored.bytes_per_leaf())},
      {"bytes_per_hypothesis", if_stored(stored.bytes_per_hypothesis())},
      {"peak_resident_bytes", peak_resident_bytes()}};
}

}  // namespace cairn::lab
