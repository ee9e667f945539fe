#pragma once

#include <cstddef>
#include <vector>

#include "bench/lab/building_drive.hpp"

namespace cairn::lab {

/// How well the places of a building were perceived, all counts.
struct BuildingScore {
  std::size_t passages = 0;      ///< Of junctions that are places, by the robot's true walk.
  std::size_t noticed = 0;       ///< Of them, those that became visits.
  std::size_t false_places = 0;  ///< Visits where no place is: in straight corridors.
  std::size_t gateways = 0;      ///< True ones at the passages noticed.
  std::size_t gateways_found = 0;
  std::size_t gateways_false = 0;  ///< Perceived where no corridor leaves.
  std::size_t stars_true = 0;      ///< Visits with all gateways, none false, continued as they are.
  std::size_t revisits = 0;        ///< Visits to junctions visited before.
  std::size_t same_star = 0;       ///< Of them, those with the star of the first visit.

  BuildingScore& operator+=(const BuildingScore& other);
};

/// Whether a junction is a place: a dead end, a corner or where three corridors or more meet. A
/// junction with two corridors in line is the middle of a corridor.
[[nodiscard]] bool is_place(const Building& building, int junction);

/// The junctions on the tour of a session, in order.
[[nodiscard]] std::vector<int> walk_of(const Building& building, int session, int travels);

/// Scores the visits of one session, in order, against the junctions that were passed, in order.
/// What a corner is cut by, a junction may be off: the visits are laid along the walk so that most
/// agree.
[[nodiscard]] BuildingScore score_of(const Building& building,
                                     const std::vector<int>& walk,
                                     const std::vector<SimulatedVisit>& visits);

}  // namespace cairn::lab
