#pragma once

#include "exact_search/exact_search_state.hpp"
#include "exact_search/map_counts.hpp"

namespace cairn {

/// Collects the counts of an enumeration. Canonical codes are the caller's: it knows the maps.
class MapTally {
 public:
  MapTally(const ObservedWalk& walk, int max_codes);

  void count_start();
  /// A leaf after `step`, not the last one.
  void count(const Successor& leaf, int step);
  /// Which codes of a final map are worth their making.
  struct WantedCodes {
    bool optimal = false;
    bool minimal_region = false;
  };
  WantedCodes count_final(const MapSummary& map);
  void add_code(WantedCodes wanted, const std::string& code);
  [[nodiscard]] std::int64_t tree_nodes() const { return counts_.tree_nodes; }
  /// The counts, codes sorted.
  [[nodiscard]] MapCounts finish(std::int64_t view_mismatches) &&;

 private:
  bool count_optimal(const MapSummary& map);
  bool count_minimal(const MapSummary& map);

  MapCounts counts_;
  std::int64_t max_codes_;
};

}  // namespace cairn
