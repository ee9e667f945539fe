#pragma once

#include "codec/option_object.hpp"
#include "lpm/lpm_options.hpp"

namespace cairn {

/// The object "lpm" of the configuration file.
[[nodiscard]] OptionObject describe(LpmOptions* lpm);

}  // namespace cairn
