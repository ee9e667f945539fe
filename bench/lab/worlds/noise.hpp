#pragma once

#include <cstdint>

#include "bench/lab/worlds/world.hpp"
#include "topology/evidence.hpp"

namespace cairn::lab {

/// How often what is seen at a visit is not what is there. Each is drawn for every visit.
struct NoiseOptions {
  /// The star is of another kind with as many gateways.
  double misread_probability = 0.0;
  /// A gateway, neither that of arrival nor that of departure, is not seen: its path fragment then
  /// ends there, and vanishes if it has no gateway left.
  double missed_probability = 0.0;
  /// A gateway is seen where there is none: at the end of a fragment, or with one of its own.
  double false_probability = 0.0;
};
Status validate(const NoiseOptions& options);

/// The same way through the world, seen badly. Turns are counted among the gateways that were seen.
[[nodiscard]] Walk with_noise(const Walk& walk, const NoiseOptions& options, std::uint64_t seed);

/// How well the local maps of two visits match, as if by a robot's laser: a log-likelihood ratio
/// (natural logarithm) drawn from a normal distribution about +mean for the same place in the right
/// alignment, about -mean for anything else. With deviation = sqrt(2 mean) the ratios are
/// calibrated: exp(ratio) is what the draw is worth.
struct MatchModel {
  double mean = 4.0;
  double deviation = 2.83;
  std::uint64_t seed = 0;
};
Status validate(const MatchModel& model);

/// That gateway j of the later visit's star is gateway (j + shift) mod n of the earlier one's, n
/// being the number of the earlier one's gateways. The same answer whenever it is asked.
/// @pre 0 <= earlier < later < number of visits
[[nodiscard]] double match_log_likelihood_ratio(
    const Walk& walk, const MatchModel& model, int earlier, int later, int shift);

/// That the two gateways are one, all others following clockwise; also where one of the visits saw
/// more gateways than the other. Whichever gateways are asked about, the right alignment of two
/// visits to one place has one ratio.
/// @pre known.visit comes before now.visit; the gateways are of the stars that were seen
[[nodiscard]] double match_log_likelihood_ratio(const Walk& walk,
                                                const MatchModel& model,
                                                SeenGateway known,
                                                SeenGateway now);

}  // namespace cairn::lab
