#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/lab/counts.hpp"
#include "exact_search/exact_search.hpp"

namespace cairn::lab {

/// How the maps of an exploration are gone through.
enum class SearchKind {
  kBreadth,  ///< As the on-line tree does it: all leaves are kept, step by step.
  kDepth,    ///< All maps one after the other, none kept.
  kBest,     ///< The most promising first, until a map is closed.
};

/// Memory of the hypotheses that a search keeps: their nodes, which they share, and what is known
/// of each of them.
struct StoredTree {
  std::int64_t nodes = 0;  ///< 0: none is stored.
  std::int64_t bytes_of_nodes = 0;
  std::int64_t leaves = 0;  ///< Best-first: the most that ever waited.
  std::int64_t bytes_of_leaves = 0;

  [[nodiscard]] double bytes_per_node() const;
  [[nodiscard]] double bytes_per_leaf() const;
  /// A leaf and its share of the nodes.
  [[nodiscard]] double bytes_per_hypothesis() const;
  StoredTree& operator+=(const StoredTree& other);
};

/// A search and what it cost. With a bound on nodes it counts at most that many, and has come to
/// its end if it needs no more. Breadth-first search is bounded by whole travels: where one makes
/// too many nodes, what is counted is the tree before it.
struct SearchRun {
  MapCounts counts;  ///< Best-first: only nodes, maps, and the map found.
  /// Why the search did not come to its end, "given up ..."; empty if it did.
  std::string given_up;
  bool is_proven = false;  ///< Best-first: nothing that waited can be better.
  bool is_best_first = false;
  std::string best_code;      ///< Best-first: the closed map; empty if there is none.
  std::int64_t max_open = 0;  ///< Best-first: longest list of waiting nodes.
  StoredTree stored;
  double cpu_s = 0.0;
  /// Breadth-first: of counting final maps and regions afterwards, which cpu_s is without. None:
  /// counting is part of the search.
  std::optional<double> counting_cpu_s;
};

/// Best-first search looks at region-consistent maps only, so that the map it finds is optimal in
/// the sense of the files of vectors whatever else is asked for: a map that is not never heals.
/// @pre options and exploration are valid
[[nodiscard]] SearchRun run_search(SearchKind kind,
                                   const Exploration& exploration,
                                   const ExactSearchOptions& options,
                                   SearchOrder order);

/// What the optimal map, or the one that best-first search looks for, is the least of: "paths, then
/// places, of region-consistent maps without pending gateways".
[[nodiscard]] std::string minimised(SearchKind kind,
                                    const ExactSearchOptions& options,
                                    SearchOrder order);

[[nodiscard]] std::int64_t nodes_per_s(const SearchRun& run);

/// With three decimals, for JSON.
[[nodiscard]] double milliseconds(double seconds);

/// "240 nodes in 0.31 ms of CPU time (774,000 nodes/s)", whether counting is part of it, and what
/// is known of memory.
[[nodiscard]] std::string cost_text(const SearchRun& run);

/// The same for JSON: times and memory by name, null where there is none.
[[nodiscard]] Json cost_json(const SearchRun& run);

}  // namespace cairn::lab
