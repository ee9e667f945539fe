#include "exact_search/map_tally.hpp"

#include <algorithm>
#include <utility>

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

MapTally::WantedCodes MapTally::count_final(const MapSummary& map) {
  ++counts_.final_maps;
  const bool is_closed_paper = map.lone_paths == 0;
  counts_.closed_paper += is_closed_paper ? 1 : 0;
  counts_.closed_no_pending += map.pending == 0 ? 1 : 0;
  counts_.perpendicular_closed_paper += is_closed_paper && map.perpendicular ? 1 : 0;
  if (!map.region_consistent) {
    return {};
  }
  ++counts_.region_consistent_finals;
  return {map.pending == 0 && count_optimal(map), count_minimal(map)};
}

bool MapTally::count_optimal(const MapSummary& map) {
  if (!is_simplest(map, &counts_.optimal)) {
    return false;
  }
  ++counts_.optimal->count;
  if (counts_.optimal->count > max_codes_) {
    counts_.optimal->codes.clear();
    return false;
  }
  return true;
}

bool MapTally::count_minimal(const MapSummary& map) {
  if (!is_simplest(map, &counts_.minimal_region)) {
    return false;
  }
  ++counts_.minimal_region->count;
  if (!map.perpendicular) {  // A region-consistent map has no double meetings.
    return false;
  }
  ++counts_.minimal_region->count_without_triangles;
  if (counts_.minimal_region->count_without_triangles > max_codes_) {
    counts_.minimal_region->codes.clear();
    return false;
  }
  return true;
}

void MapTally::add_code(WantedCodes wanted, const std::string& code) {
  if (wanted.optimal) {
    counts_.optimal->codes.push_back(code);
  }
  if (wanted.minimal_region) {
    counts_.minimal_region->codes.push_back(code);
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
