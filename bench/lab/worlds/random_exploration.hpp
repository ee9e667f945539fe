#pragma once

#include <cstdint>
#include <string>

#include "bench/lab/worlds/world.hpp"

namespace cairn::lab {

/// A random walk in a random planar world, of a size that the slowest search can deal with: places,
/// kinds of stars and travels differ from seed to seed, and a walk with more than `most_nodes` maps
/// in its tree is cut short. Same seed, same walk.
[[nodiscard]] Walk random_exploration(std::uint64_t seed, std::int64_t most_nodes = 3000);

/// Where the robot is at a visit, as a map says it that is the true one.
struct TrueStep {
  int place = 0;    ///< Numbered 0, 1, ... as they are met.
  int gateway = 0;  ///< Of arrival, in the numbering of the star seen at the place's first visit.
};
/// For every visit. Only for walks without noise.
[[nodiscard]] std::vector<TrueStep> truth_of(const Walk& walk);

}  // namespace cairn::lab
