#pragma once

#include <string>
#include <vector>

#include "layout/place_layout.hpp"

namespace cairn {

/// One try to lay out places: how it began, where it ended, and whether that is a least sum of
/// squares.
struct LayoutAttempt {
  double initial_chi2 = 0.0;  ///< Of the start.
  PlaceLayout layout;         ///< Where the descent ended; no layout to use unless is_converged.
  bool is_converged = false;
  std::string reason;  ///< Why it did not converge; else empty.
};

/// Descends from given poses, however bad, to the nearest least sum of squares; from the linear
/// start where there are none. A start far from the travels may end in a least that is not the
/// lowest: `solve_layout` chooses its start. For those who compare starts.
///
/// @param start by place, any frame, all finite; or null
///
/// Errors: as of `solve_layout`, but for kNotConverged; kInvalidValue for a start that is not
/// finite or not one pose for every place.
[[nodiscard]] Result<LayoutAttempt> attempt_layout(int place_count,
                                                   const std::vector<TravelConstraint>& travels,
                                                   const LayoutOptions& options = {},
                                                   const std::vector<Pose2>* start = nullptr);

}  // namespace cairn
