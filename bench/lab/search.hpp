#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exact_search/exact_search.hpp"

namespace cairn::lab {

/// How the maps of an exploration are gone through.
enum class SearchKind {
  kBreadth,  ///< As the on-line tree does it: all leaves are kept, step by step.
  kDepth,    ///< All maps one after the other, none kept.
  kBest,     ///< The most promising first, until a map is closed.
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
  std::string best_code;           ///< Best-first: the closed map; empty if there is none.
  std::int64_t max_open = 0;       ///< Best-first: longest list of waiting nodes.
  std::size_t bytes_per_node = 0;  ///< 0: no node is stored.
  double cpu_s = 0.0;
};

/// @pre options and exploration are valid
[[nodiscard]] SearchRun run_search(SearchKind kind,
                                   const Exploration& exploration,
                                   const ExactSearchOptions& options,
                                   SearchOrder order);

[[nodiscard]] std::int64_t nodes_per_s(const SearchRun& run);

/// With three decimals, for JSON.
[[nodiscard]] double milliseconds(double seconds);

/// "240 nodes in 0.31 ms of CPU time (774,000 nodes/s)" and what is known of memory.
[[nodiscard]] std::string cost_text(const SearchRun& run);

}  // namespace cairn::lab
