#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `trajectory` to the program: the error of the whole chain on a recorded log over true
/// relations, before and after the refinement, and which travels contribute to it.
void add_trajectory_command(CLI::App& app, const Streams& streams);

}  // namespace cairn::lab
