#include "bench/lab/worlds/random_source.hpp"

#include <cmath>

namespace cairn::lab {

RandomSource::RandomSource(std::uint64_t seed, std::uint64_t stream) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(stream),
                         static_cast<std::uint32_t>(stream >> 32U)};
  engine_.seed(sequence);
}

int RandomSource::below(int count) {
  // 32 random bits times the count, of which the upper half: off by less than count / 2^32.
  return static_cast<int>((std::uint64_t{engine_()} * static_cast<std::uint64_t>(count)) >> 32U);
}

double RandomSource::uniform() {
  return static_cast<double>(engine_()) * 0x1.0p-32;
}

double RandomSource::normal() {
  // Marsaglia's polar method; the second number of the pair is not kept.
  double u = 0.0;
  double square = 0.0;
  do {
    u = 2.0 * uniform() - 1.0;
    const double v = 2.0 * uniform() - 1.0;
    square = u * u + v * v;
  } while (square >= 1.0 || square == 0.0);
  return u * std::sqrt(-2.0 * std::log(square) / square);
}

}  // namespace cairn::lab
