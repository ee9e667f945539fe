#pragma once

#include <filesystem>

#include "bench/lab/islands_experiment.hpp"

namespace cairn::lab {

/// Draws the building twice, one above the other: the distinctiveness of each pose, green where it
/// is high, and the error, green where it is low. Throws clients::Failure(kCannotCreate).
void draw_islands(const sim::World& world,
                  const IslandsRun& run,
                  const IslandsOptions& options,
                  const std::filesystem::path& png);

}  // namespace cairn::lab
