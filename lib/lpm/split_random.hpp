#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/angle.hpp"

namespace cairn {

/// Random numbers from a seed, the same on every machine, that split into independent streams: a
/// stream per scan does not depend on how many numbers the scans before it have used.
///
/// Source: SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014).
class SplitRandom {
 public:
  explicit SplitRandom(std::uint64_t seed) : state_(mixed(seed + kGamma)) {}

  /// The stream of this number; the same for the same number, whatever was drawn meanwhile.
  [[nodiscard]] SplitRandom split(std::uint64_t stream) const {
    return SplitRandom(root_ ^ mixed(stream + kGamma));
  }
  [[nodiscard]] std::uint64_t bits() {
    state_ += kGamma;
    return mixed(state_);
  }
  /// In [0, 1).
  [[nodiscard]] double uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  /// Of mean 0 and variance 1, by Box and Muller.
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
  }

 private:
  static constexpr std::uint64_t kGamma = 0x9E3779B97F4A7C15U;
  static constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
  std::uint64_t root_ = state_;
};

}  // namespace cairn
