#pragma once

#include <filesystem>

#include "bench/lab/localmap_run.hpp"

namespace cairn::lab {

/// Draws what was seen from where the local layer believed to be: returns dark, the darker the
/// oftener, the way in colours from blue to red. Throws clients::Failure(kCannotCreate).
void draw_localmap(const LocalmapRun& run, const std::filesystem::path& png);

}  // namespace cairn::lab
