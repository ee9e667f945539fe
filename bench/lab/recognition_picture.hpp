#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/lab/recognition_fit.hpp"

namespace cairn::lab {

struct ErrorCurve {
  std::string name;
  std::vector<ErrorRates> rates;  ///< By ascending threshold.
};

/// Draws the shares of false (red) and missed matches (blue) over the threshold, the curves after
/// the first one dashed ever finer. Throws Failure(kCannotCreate) if the file cannot be written.
void draw_error_curves(const std::vector<ErrorCurve>& curves, const std::filesystem::path& png);

}  // namespace cairn::lab
