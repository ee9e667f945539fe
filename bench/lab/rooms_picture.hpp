#pragma once

#include <filesystem>

#include "region/region_graph.hpp"

namespace cairn::lab {

/// Draws the regions in colours, one pixel a cell, their centres, and the critical lines in red.
/// Throws Failure(kCannotCreate) if the file cannot be written.
void draw_regions(const OccupancyGrid& grid,
                  const RegionGraph& graph,
                  const std::filesystem::path& png);

}  // namespace cairn::lab
