#include "clients/sim/random_source.hpp"

#include <cmath>

namespace cairn::sim {

RandomSource::RandomSource(std::uint64_t seed, std::uint64_t stream) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(stream)};
  engine_.seed(sequence);
}

double RandomSource::uniform() {
  return static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

double RandomSource::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  // Marsaglia's polar method: two normals from a point drawn in the unit disc.
  double u = 0.0;
  double v = 0.0;
  double square = 0.0;
  do {
    u = 2.0 * uniform() - 1.0;
    v = 2.0 * uniform() - 1.0;
    square = u * u + v * v;
  } while (square >= 1.0 || square == 0.0);
  const double factor = std::sqrt(-2.0 * std::log(square) / square);
  spare_normal_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

}  // namespace cairn::sim
