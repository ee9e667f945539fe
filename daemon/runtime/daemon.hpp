#pragma once

#include "runtime/daemon_options.hpp"
#include "runtime/exit_code.hpp"

namespace cairn {

/// Runs the service until SIGTERM or SIGINT: opens the bus and the map file, listens, maps,
/// answers. What goes wrong at the start is said in one line, with what to do about it.
[[nodiscard]] ExitCode serve(const DaemonOptions& options);

/// Opens the bus, sends a message to itself and says how that went.
[[nodiscard]] ExitCode test_bus(const DaemonOptions& options);

}  // namespace cairn
