#pragma once

#include <string>

#include "bench/lab/worlds/world.hpp"

namespace cairn::lab {

/// Canonical code of the true map, as far as the walk saw it.
/// @pre the walk is without noise
[[nodiscard]] std::string code_of_truth(const Walk& walk);

}  // namespace cairn::lab
