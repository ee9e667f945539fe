#pragma once

#include "exact_search/exact_search_state.hpp"
#include "exact_search/map_counts.hpp"

namespace cairn {

/// Collects the counts of an enumeration. What must be looked at closer comes from the caller: it
/// knows the maps.
class MapTally {
 public:
  MapTally(const ObservedWalk& walk, int max_codes);

  void count_start();
  /// A leaf after `step`, not the last one.
  void count(const Successor& leaf, int step);
  /// What of a final map is worth its making.
  struct Wanted {
    bool optimal_code = false;
    bool minimal_code = false;
    bool order = false;  ///< Of places on paths.
    [[nodiscard]] bool any() const { return optimal_code || order; }
  };
  Wanted count_final(const MapSummary& map);
  /// @param wanted as count_final() said for this map, just before
  void look_closer(Wanted wanted, const TopologicalMap& map);
  [[nodiscard]] std::int64_t tree_nodes() const { return counts_.tree_nodes; }
  /// The counts, codes sorted.
  [[nodiscard]] MapCounts finish(std::int64_t view_mismatches) &&;

 private:
  void count_optimal(const MapSummary& map, Wanted* wanted);
  void count_minimal(const MapSummary& map, Wanted* wanted);

  MapCounts counts_;
  std::int64_t max_codes_;
};

}  // namespace cairn
