#include "exact_search/map_tally.hpp"

#include <algorithm>
#include <utility>

#include "exact_search/order_atoms.hpp"

namespace cairn {
namespace {

/// Starts again at a simpler map. Returns whether the map is one of the simplest so far.
template <typename Simplest>
bool is_simplest(const MapSummary& map, std::optional<Simplest>* simplest) {
  const auto simplicity = std::pair(map.paths, map.places);
  if (!simplest->has_value() || simplicity < std::pair((*simplest)->paths, (*simplest)->places)) {
    simplest->emplace();
    (*simplest)->paths = map.paths;
    (*simplest)->places = map.places;
    return true;
  }
  return simplicity == std::pair((*simplest)->paths, (*simplest)->places);
}

}  // namespace

MapTally::MapTally(const ObservedWalk& walk, int max_codes) : max_codes_(max_codes) {
  counts_.leaves_per_step.assign(static_cast<std::size_t>(walk.step_count()), 0);
  counts_.region_leaves_per_step = counts_.leaves_per_step;
}

void MapTally::count_start() {
  ++counts_.tree_nodes;
  ++counts_.maps_built;
}

void MapTally::count(const Successor& leaf, int step) {
  ++counts_.tree_nodes;
  counts_.maps_built += leaf.change.kind == MapChange::Kind::kNothing ? 0 : 1;
  ++counts_.leaves_per_step[static_cast<std::size_t>(step)];
  counts_.region_leaves_per_step[static_cast<std::size_t>(step)] +=
      leaf.summary.region_consistent ? 1 : 0;
}

MapTally::Wanted MapTally::count_final(const MapSummary& map) {
  ++counts_.final_maps;
  const bool is_closed_paper = map.lone_paths == 0;
  counts_.closed_paper += is_closed_paper ? 1 : 0;
  counts_.closed_no_pending += map.pending == 0 ? 1 : 0;
  counts_.perpendicular_closed_paper += is_closed_paper && map.perpendicular ? 1 : 0;
  Wanted wanted;
  if (map.region_consistent) {
    ++counts_.region_consistent_finals;
    count_optimal(map, &wanted);
    count_minimal(map, &wanted);
  }
  return wanted;
}

void MapTally::count_optimal(const MapSummary& map, Wanted* wanted) {
  if (map.pending > 0 || !is_simplest(map, &counts_.optimal)) {
    return;
  }
  ++counts_.optimal->count;
  wanted->optimal_code = counts_.optimal->count <= max_codes_;
  if (!wanted->optimal_code) {
    counts_.optimal->codes.clear();
  }
}

void MapTally::count_minimal(const MapSummary& map, Wanted* wanted) {
  if (!is_simplest(map, &counts_.minimal_region)) {
    return;
  }
  ++counts_.minimal_region->count;
  wanted->order = true;
  if (!map.perpendicular) {  // A region-consistent map has no double meetings.
    return;
  }
  ++counts_.minimal_region->count_without_triangles;
  wanted->minimal_code = counts_.minimal_region->count_without_triangles <= max_codes_;
  if (!wanted->minimal_code) {
    counts_.minimal_region->codes.clear();
  }
}

void MapTally::look_closer(Wanted wanted, const TopologicalMap& map) {
  if (wanted.optimal_code || wanted.minimal_code) {
    const std::string code = canonical_code(map);
    if (wanted.optimal_code) {
      counts_.optimal->codes.push_back(code);
    }
    if (wanted.minimal_code) {
      counts_.minimal_region->codes.push_back(code);
    }
  }
  if (wanted.order) {
    count_order_atoms(map, &*counts_.minimal_region);
  }
}

MapCounts MapTally::finish(std::int64_t view_mismatches) && {
  counts_.view_mismatches = view_mismatches;
  if (counts_.optimal) {
    std::sort(counts_.optimal->codes.begin(), counts_.optimal->codes.end());
  }
  if (counts_.minimal_region) {
    std::sort(counts_.minimal_region->codes.begin(), counts_.minimal_region->codes.end());
  }
  return std::move(counts_);
}

}  // namespace cairn
