#pragma once

#include "runtime/mapping_thread.hpp"

namespace cairn {

/// Tells the log what the visits of a report did to the tree of maps: live and waiting hypotheses,
/// what a repair blamed, where the guarantee ended.
void log_extensions(const MappingReport& report);
/// Tells the log what an operator said, if the report answers him and it was not said before.
void log_assertion(const MappingReport& report);

}  // namespace cairn
