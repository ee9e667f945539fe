#pragma once

#include "exact_search/exact_search.hpp"
#include "support/obvious_tree.hpp"

namespace cairn::test {

/// The same options for the exact searches; all codes are kept.
inline ExactSearchOptions all_codes(const ObviousTreeOptions& options) {
  ExactSearchOptions search;
  search.planar = options.planar;
  search.region_consistent = options.region_consistent;
  search.max_places = options.max_places;
  search.max_codes = 1'000'000;
  return search;
}

}  // namespace cairn::test
