#pragma once

#include <vector>

#include "base/result.hpp"
#include "layout/place_layout.hpp"

namespace cairn {

/// How well a travel agrees with all others.
struct Agreement {
  /// Squared Mahalanobis distance of what the travel says from what all others say of the same two
  /// places: chi2 with 3 degrees of freedom where both are right. 0 where no others say anything.
  double chi2 = 0.0;
  /// The chi2 as a deviate of the standard normal distribution: what is as improbable. >= 0
  double sigmas = 0.0;
  /// Smallest share of the travel's own information that others could contradict, by direction: 0
  /// where it alone holds two parts of the map together. [0, 1]
  double checked_share = 0.0;
};

/// Holds every travel of a layout against all others: as if it were left out, the rest laid out
/// anew, and the two compared, to first order about the layout.
///
/// A residual alone says too little: a travel that is all that holds a loop together bends the
/// others to itself, and has a small one.
/// @param layout of these travels, at its optimum
/// Errors: kNotConverged where the curvature is singular there.
///
/// Source: leave-one-out residuals of least squares (Cook and Weisberg, "Residuals and Influence in
/// Regression", 1982, Sec. 2.2).
[[nodiscard]] Result<std::vector<Agreement>> agreements_of(
    const PlaceLayout& layout, const std::vector<TravelConstraint>& travels);

/// The deviate of the standard normal distribution that is exceeded as seldom as a chi2 with 3
/// degrees of freedom; 0 for what is exceeded half of the time or more. To 0.05 up to 4 (Wilson and
/// Hilferty, 1931).
[[nodiscard]] double normal_deviate_of_chi2(double chi2);

}  // namespace cairn
