#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `layout` to the program: lays out the pose graph of a file and says how well and how fast.
/// Its exit status, in *status, is 1 where the layout has not converged.
void add_layout_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
