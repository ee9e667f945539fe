#pragma once

#include <vector>

#include "codec/option_object.hpp"
#include "service/options.hpp"

namespace cairn {

/// The stages' options as objects of the configuration file, in the order of the pipeline, bound to
/// `options`, which must outlive them.
[[nodiscard]] std::vector<OptionObject> describe(ServiceOptions* options);

}  // namespace cairn
