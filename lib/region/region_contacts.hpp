#pragma once

#include <array>
#include <vector>

#include "region/clearance_basins.hpp"

namespace cairn {

/// A cell of one basin beside a cell of another one.
struct BasinContact {
  std::int32_t from = 0;  ///< Basins, from < to.
  std::int32_t to = 0;
  Cell cell;                       ///< Of the window.
  std::int32_t squared_cells = 0;  ///< Clearance where one steps across, the less of both cells.
};

/// All contacts, ordered by basins, then by cell. Two basins that are open to each other at several
/// places have contacts at each of them.
[[nodiscard]] std::vector<BasinContact> contacts_of(const ClearanceBasins& basins,
                                                    const DistanceTransform& distances);

/// Gives basins of less than the least area to the neighbour across the widest opening, the
/// smallest first; those that have no neighbour are dropped. Numbers what is left without gaps, in
/// the order of the lowest cells.
void join_small_basins(const DistanceTransform& distances,
                       double min_area_m2,
                       ClearanceBasins* basins);

}  // namespace cairn
