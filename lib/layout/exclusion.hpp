#pragma once

#include <vector>

#include "layout/place_layout.hpp"

namespace cairn {

/// Two places cannot be at one spot.
struct Exclusion {
  double apart_m = 0.7;     ///< Two places are farther from each other than this. > 0
  double log_least = -7.0;  ///< Of each pair: what looks so may be two floors. <= 0
};

/// What speaks against places lying so because places lie on each other: the sum over pairs of
/// places of the log of the probability that they are apart. <= 0, and 0 where none come near each
/// other.
///
/// How uncertain a distance is, is taken from the surest way between the two places by the travels:
/// never surer than it truly is, as other ways would only add to it.
///
/// @param T_global_place by place
/// @param travels join all of them; their covariances are positive definite
[[nodiscard]] double log_exclusion(const std::vector<Pose2>& T_global_place,
                                   const std::vector<TravelConstraint>& travels,
                                   const Exclusion& exclusion);

}  // namespace cairn
