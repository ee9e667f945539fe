#pragma once

#include <string>
#include <vector>

#include "runtime/daemon_options.hpp"
#include "runtime/exit_code.hpp"

namespace cairn {

/// Runs recorded logs through the same inlets and the same service as live traffic, as fast as the
/// machine allows, into a new map file, and prints a summary. The same logs give the same bytes.
///
/// A damaged log ends the replay with kBadData; what was read until then is kept.
[[nodiscard]] ExitCode replay(const DaemonOptions& options,
                              const std::vector<std::string>& logs,
                              const std::string& map_file,
                              bool as_json);

}  // namespace cairn
