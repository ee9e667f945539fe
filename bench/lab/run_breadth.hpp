#pragma once

#include "bench/lab/search.hpp"

namespace cairn::lab {

/// The exploration told step by step to the on-line tree in strict mode, all consistent leaves
/// kept. The CPU time is the tree's; looking at the maps afterwards, and a second tree for the
/// leaves that are region-consistent, are counting.
/// @pre no option is set but planar, region_consistent, max_places, max_nodes and max_codes
[[nodiscard]] SearchRun run_breadth(const Exploration& exploration,
                                    const ExactSearchOptions& options);

}  // namespace cairn::lab
