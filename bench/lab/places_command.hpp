#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `places` to the program: what the robot's way through a recorded log shows of places. The
/// exit status of a run that has come to its end is left in *status.
void add_places_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
