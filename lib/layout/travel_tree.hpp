#pragma once

#include <vector>

#include "layout/place_layout.hpp"

namespace cairn {

/// The least uncertain ways from given places to all others, as a tree of travels. Part of the
/// place layout; not for other layers.
struct TravelTree {
  std::vector<int> order;   ///< Places reached, nearest first; each after its parent.
  std::vector<int> parent;  ///< By place; -1 for roots and for places not reached.
  std::vector<int> travel;  ///< By place: travel that joins it to its parent, or -1.
};

/// Uncertainty of a way: the sum over its travels of the trace of the covariance, 1 rad as 1 m.
/// Ties go to the lower place, then to the earlier travel.
/// @pre indices of travels are in [0, place_count)
[[nodiscard]] TravelTree least_uncertain_ways(int place_count,
                                              const std::vector<TravelConstraint>& travels,
                                              const std::vector<int>& roots);

/// T_parent_place of a place of the tree.
/// @pre tree.parent[place] >= 0
[[nodiscard]] GaussianPose displacement_from_parent(const TravelTree& tree,
                                                    const std::vector<TravelConstraint>& travels,
                                                    int place);

}  // namespace cairn
