#pragma once

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// Adds `closures` to the program: the places of the best map of a recorded log, held against a
/// reference trajectory. Its exit status, in *status, is 1 where there is a false closure.
void add_closures_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
