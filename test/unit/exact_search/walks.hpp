#pragma once

#include <random>

#include "exact_search/exact_search.hpp"
#include "support/lattice.hpp"

namespace cairn::test {

/// A random walk through a grid some of whose streets are missing.
inline Walk random_walk(unsigned seed, int rows, int columns, int steps) {
  std::mt19937 random(seed);
  Lattice lattice(rows, columns);
  for (int tries = 0; tries < 2; ++tries) {
    const int place = static_cast<int>(random() % static_cast<unsigned>(rows * columns));
    const int direction = static_cast<int>(random() % 4);
    if (lattice.is_open(place, direction) && lattice.degree(place) > 2 &&
        lattice.degree(lattice.neighbour(place, direction)) > 2) {
      lattice.remove_street(place, direction);
    }
  }
  return lattice.walk(0, lattice.random_moves(0, steps, random));
}

inline ExactSearchOptions planar(bool perpendicular = false) {
  ExactSearchOptions options;
  options.planar = true;
  options.perpendicular = perpendicular;
  return options;
}

}  // namespace cairn::test
