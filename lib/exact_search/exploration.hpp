#pragma once

#include <vector>

#include "star/star.hpp"

namespace cairn {

/// A travel of an exploration and what was seen at its end.
struct ExplorationStep {
  int turn = 0;  ///< Gateways clockwise from the one of arrival to the one of departure.
  Star star;
  int arrival_gateway = 0;  ///< Of `star`.
};

/// A whole experience, told once it is over: what the searches of Savelli and Kuipers (IROS 2004,
/// Fig. 4) are run on. Without evidence from outside.
struct Exploration {
  Star start;
  int start_gateway = 0;  ///< From which the first turn is counted.
  std::vector<ExplorationStep> steps;
};

/// Whether every step is possible: valid stars that have their gateways, turns in
/// [0, number of gateways of the place before). Names the first step that is not, with its values.
Status validate(const Exploration& exploration);

}  // namespace cairn
