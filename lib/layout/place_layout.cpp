#include "layout/place_layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/validator.hpp"
#include "layout/displacement.hpp"
#include "layout/layout_attempt.hpp"
#include "layout/travel_residual.hpp"
#include "layout/travel_tree.hpp"

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Whether the travels may join all places; what is wrong with them is for `attempt_layout` to say.
bool are_sound(int place_count, const std::vector<TravelConstraint>& travels) {
  const bool are_enough = place_count >= 1 && travels.size() + 1 >= at(place_count);
  return are_enough &&
         std::all_of(travels.begin(), travels.end(), [&](const TravelConstraint& travel) {
           return travel.from >= 0 && travel.from < place_count && travel.to >= 0 &&
                  travel.to < place_count && validate_displacement(travel.T_from_to).ok();
         });
}

/// The earlier layout moved to the frame of its place 0, with the other places chained on.
std::optional<std::vector<Pose2>> start_from(const PlaceLayout* previous,
                                             int place_count,
                                             const std::vector<TravelConstraint>& travels) {
  if (previous == nullptr || previous->T_global_place.empty() || !are_sound(place_count, travels) ||
      previous->T_global_place.size() > at(place_count)) {
    return std::nullopt;
  }
  std::vector<Pose2> T_global_place(at(place_count));
  std::vector<int> known;
  const Pose2 T_first_global = previous->T_global_place.front().inverse();
  for (const Pose2& T_previous_place : previous->T_global_place) {
    const Pose2 T_first_place = T_first_global * T_previous_place;
    if (!std::isfinite(T_first_place.x() + T_first_place.y() + T_first_place.theta())) {
      return std::nullopt;
    }
    T_global_place[known.size()] = T_first_place;
    known.push_back(static_cast<int>(known.size()));
  }
  const TravelTree tree = least_uncertain_ways(place_count, travels, known);
  for (const int place : tree.order) {
    if (tree.parent[at(place)] >= 0) {
      T_global_place[at(place)] = T_global_place[at(tree.parent[at(place)])] *
                                  displacement_from_parent(tree, travels, place).mean;
    }
  }
  return T_global_place;
}

/// Beyond three standard deviations in the mean, an earlier layout says little.
bool says_little(const std::vector<Pose2>& T_global_place,
                 const std::vector<TravelConstraint>& travels) {
  const auto coordinates = [&](int place) -> Eigen::Vector3d {
    const Pose2& pose = T_global_place[at(place)];
    return {pose.x(), pose.y(), pose.theta()};
  };
  double chi2 = 0.0;
  for (const TravelConstraint& travel : travels) {
    chi2 += residual_of(travel).at(coordinates(travel.from), coordinates(travel.to)).squaredNorm();
  }
  return chi2 > 27.0 * static_cast<double>(travels.size());
}

}  // namespace

Status validate(const LayoutOptions& options) {
  return Validator("layout")
      .within("max_iterations", options.max_iterations, 1, 10'000)
      .within("outlier_sigmas", options.outlier_sigmas, 0.0, 1000.0)
      .status();
}

Result<PlaceLayout> solve_layout(int place_count,
                                 const std::vector<TravelConstraint>& travels,
                                 const LayoutOptions& options,
                                 const PlaceLayout* previous) {
  std::optional<std::vector<Pose2>> start = start_from(previous, place_count, travels);
  if (start && says_little(*start, travels)) {
    start.reset();
  }
  Result<LayoutAttempt> attempt =
      attempt_layout(place_count, travels, options, start ? &*start : nullptr);
  if (!attempt) {
    return attempt.error();
  }
  if (!attempt->is_converged) {
    return Error{ErrorCode::kNotConverged, attempt->reason};
  }
  return std::move(attempt->layout);
}

}  // namespace cairn
