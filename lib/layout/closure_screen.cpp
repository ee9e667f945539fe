#include "layout/closure_screen.hpp"

#include <algorithm>
#include <string>

#include "layout/displacement.hpp"
#include "layout/travel_tree.hpp"

namespace cairn {
namespace {

bool names_places(const TravelConstraint& travel, int place_count) {
  return travel.from >= 0 && travel.from < place_count && travel.to >= 0 && travel.to < place_count;
}

}  // namespace

Result<GaussianPose> chained_displacement(int place_count,
                                          const std::vector<TravelConstraint>& travels,
                                          int from,
                                          int to) {
  const auto is_known = [&](const TravelConstraint& travel) {
    return names_places(travel, place_count);
  };
  if (!is_known({from, to, {}}) || !std::all_of(travels.begin(), travels.end(), is_known)) {
    return Error{ErrorCode::kInvalidValue,
                 "closure: places must be in [0, " + std::to_string(place_count) + ")"};
  }
  const TravelTree tree = least_uncertain_ways(place_count, travels, {from});
  GaussianPose T_place_to;
  for (int place = to; place != from; place = tree.parent[static_cast<std::size_t>(place)]) {
    if (tree.parent[static_cast<std::size_t>(place)] < 0) {
      return Error{ErrorCode::kNotFound, "closure: no travels lead from place " +
                                             std::to_string(from) + " to place " +
                                             std::to_string(to)};
    }
    T_place_to = compounded(displacement_from_parent(tree, travels, place), T_place_to);
  }
  return T_place_to;
}

Result<double> closure_chi2(int place_count,
                            const std::vector<TravelConstraint>& travels,
                            const TravelConstraint& closure) {
  if (const Status sound = validate_displacement(closure.T_from_to); !sound) {
    return sound.error();
  }
  const Result<GaussianPose> predicted =
      chained_displacement(place_count, travels, closure.from, closure.to);
  if (!predicted) {
    return predicted.error();
  }
  return squared_mahalanobis(closure.T_from_to.mean, predicted->mean,
                             closure.T_from_to.covariance + predicted->covariance);
}

}  // namespace cairn
