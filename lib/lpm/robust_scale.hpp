#pragma once

namespace cairn {

/// How an error speaks for a larger (> 0) or smaller (< 0) variance than the one that was expected:
/// in [-1, 1), and 0 on average where normal errors have that variance.
///
/// The score of the scale of Cauchy's distribution: bounded, so that a gross error counts as little
/// more than a large one, and as much upwards as downwards.
/// @pre variance > 0
[[nodiscard]] inline double scale_score(double error, double variance) {
  // The square of Cauchy's scale g that suits normal errors of variance 1, for which
  // 1 = 2 g sqrt(pi / 2) exp(g^2 / 2) erfc(g / sqrt(2)).
  constexpr double kCauchyOfNormal = 0.3746;
  const double square = error * error / variance;
  return (square - kCauchyOfNormal) / (square + kCauchyOfNormal);
}

}  // namespace cairn
