#pragma once

#include <cstdint>

#include "bench/lab/worlds/random_source.hpp"
#include "bench/lab/worlds/world.hpp"

namespace cairn::lab {

struct RandomWorldOptions {
  /// Dead ends that finish what is left open may make it more.
  int places = 12;
  /// How many kinds of stars there are; few kinds make places hard to tell apart.
  int star_kinds = 3;
  /// Of opening a gateway into a known part of the face rather than a new place.
  double closing_probability = 0.5;
};
Status validate(const RandomWorldOptions& options);

/// One star of a random kind: dead end, corridor, L, T, +, Y, K, or with random fragments.
[[nodiscard]] Star random_star(RandomSource& random);

/// A world that is planar and in which no place lies twice on a path: it grows place by place, and
/// a gateway is linked to another one only within a face. Same seed, same world.
[[nodiscard]] World random_world(const RandomWorldOptions& options, std::uint64_t seed);

/// Streets on a square grid, each closed with the given probability; what is not connected to the
/// largest part is left out. Same seed, same world.
/// @pre rows, columns >= 2; the probability is in [0, 0.4]
[[nodiscard]] World random_streets(int rows,
                                   int columns,
                                   double closed_probability,
                                   std::uint64_t seed);

struct RandomWalkOptions {
  int travels = 12;
  /// Of turning back although other ways lead on. In dead ends there is no choice.
  double turning_back_probability = 0.1;
  /// Of taking a gateway that nobody has been through, where there is one.
  double exploring_probability = 0.5;
  /// The gateways of a place are numbered from another one at each visit, as a robot does it that
  /// has no compass.
  bool renumbered = true;
};
Status validate(const RandomWalkOptions& options);

[[nodiscard]] Walk random_walk(const World& world,
                               const RandomWalkOptions& options,
                               std::uint64_t seed);

}  // namespace cairn::lab
