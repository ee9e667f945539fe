#pragma once

#include <vector>

#include "base/result.hpp"
#include "layout/place_layout.hpp"

namespace cairn {

/// T_from_to as chained along the least uncertain way of travels between two places. The
/// uncertainty of a travel is the trace of its covariance, with 1 rad counted as 1 m; ties go to
/// the earlier travel.
///
/// kNotFound where no way of travels joins the two; kInvalidValue for indices out of range.
/// Cost: O(travels x log places).
[[nodiscard]] Result<GaussianPose> chained_displacement(
    int place_count, const std::vector<TravelConstraint>& travels, int from, int to);

/// How far a proposed closure is from what the travels predict: the squared Mahalanobis length of
/// the difference of `closure` and the chained displacement, under the sum of their covariances. 3
/// degrees of freedom: more than 16.3 happens once in a thousand. A cheap screen before a layout is
/// solved; loops among the travels make the true prediction at least as certain.
///
/// Errors as of `chained_displacement`, and kInvalidValue for a closure that is not positive
/// definite.
[[nodiscard]] Result<double> closure_chi2(int place_count,
                                          const std::vector<TravelConstraint>& travels,
                                          const TravelConstraint& closure);

}  // namespace cairn
