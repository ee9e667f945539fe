#pragma once

#include <string>

#include "exact_search/exploration.hpp"
#include "support/lattice.hpp"

namespace cairn::test {

inline Exploration exploration_of(const Walk& walk) {
  Exploration exploration{walk.start.star, walk.start.arrival_gateway, {}};
  for (const Experienced& step : walk.steps) {
    exploration.steps.push_back({step.action.turn, step.view.star, step.view.arrival_gateway});
  }
  return exploration;
}

/// A grid, every row and then every column, from the north-west corner.
inline Exploration snake(int rows, int columns) {
  return exploration_of(Lattice(rows, columns).walk(0, snake_moves(rows, columns)));
}

}  // namespace cairn::test
