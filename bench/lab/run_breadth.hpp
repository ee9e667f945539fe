#pragma once

#include "bench/lab/search.hpp"

namespace cairn::lab {

/// The exploration told step by step, all consistent leaves kept. Fills in everything but the CPU
/// time.
[[nodiscard]] SearchRun run_breadth(const Exploration& exploration,
                                    const ExactSearchOptions& options);

}  // namespace cairn::lab
