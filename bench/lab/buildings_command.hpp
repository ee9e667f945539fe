#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `buildings` to the program: how well the junctions of made-up buildings are perceived.
void add_buildings_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
