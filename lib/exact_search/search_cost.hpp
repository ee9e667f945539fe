#pragma once

#include <compare>
#include <cstdint>

#include "exact_search/exact_search_state.hpp"

namespace cairn {

/// What SearchOrder compares: never more than of any closed map that follows, and exact at closed
/// maps.
struct SearchCost {
  std::int32_t first = 0;
  std::int32_t second = 0;
  friend auto operator<=>(const SearchCost&, const SearchCost&) = default;
};

/// Terminated ends stand for paths: a closed map has half as many. Corners still needed count as
/// places, and as a path each, where CornerBound is in use.
[[nodiscard]] inline SearchCost cost_of(const MapSummary& map, SearchOrder order) {
  const std::int32_t places = map.places + map.corners_needed;
  const std::int32_t paths = (map.terminated_ends + 1) / 2 + map.corners_needed;
  switch (order) {
    case SearchOrder::kPlaces:
      return {places, paths};
    case SearchOrder::kPaths:
    case SearchOrder::kPathsWithCorners:
      return {paths, places};
    case SearchOrder::kCorners:
      break;
  }
  return {map.corners + map.corners_needed, places};
}

/// CornerBound's part of a cost, if everything else of the map is known.
[[nodiscard]] inline std::int32_t corners_needed_in(const SearchCost& cost,
                                                    const MapSummary& map,
                                                    SearchOrder order) {
  return (order == SearchOrder::kPlaces ? cost.first : cost.second) - map.places;
}

}  // namespace cairn
