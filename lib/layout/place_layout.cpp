#include "layout/place_layout.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "base/validator.hpp"
#include "layout/damped_descent.hpp"
#include "layout/displacement.hpp"
#include "layout/elimination_order.hpp"
#include "layout/linear_start.hpp"
#include "layout/normal_equations.hpp"
#include "layout/travel_residual.hpp"
#include "layout/travel_tree.hpp"

namespace cairn {
namespace {

constexpr int kMaxPlaces = 1'000'000;
/// A sum of squares that is nothing but rounding.
constexpr double kNoCost = 1e-12;
/// Part of the sum of squares that is not worth another step: the last one gains its square.
constexpr double kLeastGain = 1e-6;
constexpr double kLeastShare = 1e-3;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Status validate_travels(int place_count, const std::vector<TravelConstraint>& travels) {
  if (place_count < 1 || place_count > kMaxPlaces) {
    return Error{
        ErrorCode::kInvalidValue,
        "layout: the number of places must be in [1, 1000000], is " + std::to_string(place_count)};
  }
  for (std::size_t i = 0; i < travels.size(); ++i) {
    const TravelConstraint& travel = travels[i];
    const std::string name = "layout: travel " + std::to_string(i);
    if (travel.from < 0 || travel.from >= place_count || travel.to < 0 ||
        travel.to >= place_count) {
      return Error{ErrorCode::kInvalidValue,
                   name + " must join places in [0, " + std::to_string(place_count) + "), joins " +
                       std::to_string(travel.from) + " and " + std::to_string(travel.to)};
    }
    if (const Status sound = validate_displacement(travel.T_from_to); !sound) {
      return Error{ErrorCode::kInvalidValue, name + ": " + sound.error().message};
    }
  }
  return {};
}

/// Place 0 reaches all others through travels.
Status require_connected(const TravelTree& tree) {
  for (std::size_t place = 1; place < tree.parent.size(); ++place) {
    if (tree.parent[place] < 0) {
      return Error{ErrorCode::kContradiction,
                   "layout: no travels lead from place 0 to place " + std::to_string(place)};
    }
  }
  return {};
}

/// The earlier layout moved to the frame of its place 0, with the other places chained on.
std::optional<PlaceVector> start_from(const PlaceLayout* previous,
                                      int place_count,
                                      const std::vector<TravelConstraint>& travels) {
  if (previous == nullptr || previous->T_global_place.empty() ||
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
  PlaceVector start;
  for (const Pose2& pose : T_global_place) {
    start.emplace_back(pose.x(), pose.y(), pose.theta());
  }
  return start;
}

/// Gauss-Newton steps, shortened where they overshoot.
/// @return the number of steps; none where they do not descend, with the places before
std::optional<int> descend_freely(NormalEquations* equations,
                                  const std::vector<TravelResidual>& travels,
                                  const LayoutOptions& options,
                                  PlaceVector* places) {
  double cost = cost_of(*places, travels, options.outlier_sigmas);
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    if (!equations->expand_about(*places, options.outlier_sigmas)) {
      return std::nullopt;
    }
    const Eigen::VectorXd step = equations->step();
    const double gain = equations->predicted_gain(step);
    double share = 1.0;
    PlaceVector after = moved(*places, step, share);
    double cost_after = cost_of(after, travels, options.outlier_sigmas);
    while (!(cost_after <= cost * (1.0 + 1e-9) + kNoCost)) {
      share *= 0.5;
      if (share < kLeastShare) {
        return std::nullopt;
      }
      after = moved(*places, step, share);
      cost_after = cost_of(after, travels, options.outlier_sigmas);
    }
    *places = std::move(after);
    cost = cost_after;
    if (share == 1.0 && gain <= kLeastGain * cost + kNoCost) {
      return iteration;
    }
  }
  return std::nullopt;
}

/// How a layout was found.
struct Descent {
  int iterations = 0;
  std::vector<Matrix3d> covariances;  ///< By place; empty unless asked for.
};

Result<Descent> descend(const std::vector<TravelResidual>& travels,
                        const LayoutOptions& options,
                        PlaceVector* places) {
  if (places->size() == 1) {
    return Descent{0, std::vector<Matrix3d>(options.covariances ? 1 : 0, Matrix3d::Zero())};
  }
  Descent descent;
  NormalEquations equations(static_cast<int>(places->size()), travels);
  const std::optional<int> steps = descend_freely(&equations, travels, options, places);
  if (steps) {
    descent.iterations = *steps;
  } else {
    const Result<int> damped_steps = descend_damped(travels, options, places);
    if (!damped_steps) {
      return damped_steps.error();
    }
    descent.iterations = *damped_steps;
  }
  if (options.covariances) {
    if (!equations.expand_about(*places, 0.0)) {
      return Error{ErrorCode::kNotConverged, "layout: the curvature is singular"};
    }
    descent.covariances = equations.place_covariances();
  }
  return descent;
}

/// @param number by place, its number in `places` and in the covariances
PlaceLayout report(const PlaceVector& places,
                   const std::vector<TravelResidual>& travels,
                   const Descent& descent,
                   const std::vector<int>& number) {
  PlaceLayout layout;
  layout.iterations = descent.iterations;
  for (const int position : number) {
    const Eigen::Vector3d& place = places[at(position)];
    layout.T_global_place.emplace_back(place.x(), place.y(), place.z());
    if (!descent.covariances.empty()) {
      layout.covariances.push_back(descent.covariances[at(position)]);
    }
  }
  for (const TravelResidual& travel : travels) {
    const double chi2 = travel.at(places[at(travel.from)], places[at(travel.to)]).squaredNorm();
    layout.chi2_of_travel.push_back(chi2);
    layout.chi2 += chi2;
    layout.log_likelihood -= 0.5 * (chi2 + travel.log_det_covariance + 3.0 * std::log(2.0 * kPi));
  }
  return layout;
}

std::vector<TravelConstraint> renumbered(const std::vector<TravelConstraint>& travels,
                                         const std::vector<int>& number) {
  std::vector<TravelConstraint> numbered = travels;
  for (TravelConstraint& travel : numbered) {
    travel.from = number[at(travel.from)];
    travel.to = number[at(travel.to)];
  }
  return numbered;
}

std::optional<PlaceVector> renumbered(const std::optional<PlaceVector>& places,
                                      const std::vector<int>& number) {
  if (!places) {
    return std::nullopt;
  }
  PlaceVector numbered(places->size());
  for (std::size_t place = 0; place < places->size(); ++place) {
    numbered[at(number[place])] = (*places)[place];
  }
  return numbered;
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
  if (const Status sound = validate(options); !sound) {
    return sound.error();
  }
  if (const Status sound = validate_travels(place_count, travels); !sound) {
    return sound.error();
  }
  if (const Status joined = require_connected(least_uncertain_ways(place_count, travels, {0}));
      !joined) {
    return joined.error();
  }
  const std::vector<int> number = elimination_order(place_count, travels);
  const std::vector<TravelConstraint> numbered = renumbered(travels, number);
  std::vector<TravelResidual> residuals;
  residuals.reserve(numbered.size());
  for (const TravelConstraint& travel : numbered) {
    residuals.push_back(residual_of(travel));
  }
  std::optional<PlaceVector> places =
      renumbered(start_from(previous, place_count, travels), number);
  // Beyond three standard deviations in the mean, the earlier layout says little: start anew.
  if (!places || cost_of(*places, residuals, 0.0) > 27.0 * static_cast<double>(travels.size())) {
    places = linear_start(place_count, numbered);
  }
  const Result<Descent> descent = descend(residuals, options, &*places);
  if (!descent) {
    return descent.error();
  }
  return report(*places, residuals, *descent, number);
}

}  // namespace cairn
