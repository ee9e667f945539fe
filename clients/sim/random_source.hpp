#pragma once

#include <cstdint>
#include <random>

namespace cairn::sim {

/// Random numbers that are the same on every machine and with every standard library: only the
/// engine of the library is used, since its distributions may differ.
class RandomSource {
 public:
  /// Sources of one seed but different streams are independent: the laser's noise does not change
  /// the odometry's.
  RandomSource(std::uint64_t seed, std::uint64_t stream);

  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  /// Normal with mean 0 and standard deviation 1.
  [[nodiscard]] double normal();

 private:
  std::mt19937_64 engine_;
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace cairn::sim
