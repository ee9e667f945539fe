#pragma once

namespace cairn {

/// Log lines go to stderr: with systemd's priority prefix under the journal, with time elsewhere.
void start_logging(bool verbose);

}  // namespace cairn
