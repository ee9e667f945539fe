#pragma once

#include <cstdint>
#include <random>

namespace cairn::lab {

/// Random numbers that are the same on every machine and with every standard library: only the
/// engine of the library is used, since its distributions may differ.
class RandomSource {
 public:
  /// Sources of one seed but different streams are independent.
  explicit RandomSource(std::uint64_t seed, std::uint64_t stream = 0);

  /// Uniform in {0, ..., count - 1}. @pre count >= 1
  [[nodiscard]] int below(int count);
  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  [[nodiscard]] bool chance(double probability) { return uniform() < probability; }
  /// Mean 0, standard deviation 1.
  [[nodiscard]] double normal();

 private:
  std::mt19937 engine_;
};

}  // namespace cairn::lab
