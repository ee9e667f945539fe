#pragma once

#include <cstdint>
#include <vector>

#include "bench/lab/localmap_relations.hpp"

namespace cairn::lab {

/// From when on the robot was on its way to a visit.
struct TravelSpan {
  std::int64_t visit = 0;  ///< In which the travel ends; 0: before the first.
  double begin_s = 0.0;    ///< Its first scan; it lasts until the next one begins.
};

/// What the relations with an end in one travel have of all errors.
struct TravelShare {
  std::int64_t visit = 0;
  std::int64_t relations = 0;  ///< Ends of relations.
  double mean_m = 0.0;         ///< Translational error of the relations that they belong to.
  double share = 0.0;  ///< Of the sum of all errors; half of a relation's by each end. [0, 1]
};

/// Breaks the errors down by travels, those that contribute most first. Relations whose ends have
/// no pose are left out, as judge() does.
/// @param spans in the order of time, not empty
[[nodiscard]] std::vector<TravelShare> shares_of_travels(const std::vector<Relation>& relations,
                                                         const std::vector<TrackedPose>& track,
                                                         const std::vector<TravelSpan>& spans);

}  // namespace cairn::lab
