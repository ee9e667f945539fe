#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `islands` to the program. The exit status of a run that has come to its end is left in
/// *status.
void add_islands_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
