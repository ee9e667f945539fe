#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {

/// A hypothesis that somebody asked for by its number.
struct LiveHypothesis {
  HypothesisId id;
  double probability = 0.0;  ///< Share among the live ones.
};

/// kNotFound where no live hypothesis has that number: says whether it has only ceased to be live,
/// and which ones are, the best first.
[[nodiscard]] Result<LiveHypothesis> live_hypothesis(const HypothesisTree& tree,
                                                     std::int64_t number);

}  // namespace cairn
