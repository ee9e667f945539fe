#include "layout/layout_attempt.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "layout/damped_descent.hpp"
#include "layout/displacement.hpp"
#include "layout/elimination_order.hpp"
#include "layout/linear_start.hpp"
#include "layout/normal_equations.hpp"
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

Status validate_start(int place_count, const std::vector<Pose2>& start) {
  if (start.size() != at(place_count)) {
    return Error{ErrorCode::kInvalidValue, "layout: the start must have a pose for each of " +
                                               std::to_string(place_count) + " places, has " +
                                               std::to_string(start.size())};
  }
  for (std::size_t place = 0; place < start.size(); ++place) {
    const Pose2& pose = start[place];
    if (!std::isfinite(pose.x()) || !std::isfinite(pose.y()) || !std::isfinite(pose.theta())) {
      return Error{ErrorCode::kInvalidValue,
                   "layout: the start of place " + std::to_string(place) + " must be finite"};
    }
  }
  return {};
}

/// How a descent ended.
struct Descent {
  int iterations = 0;
  bool is_converged = false;
  std::string reason;                 ///< Why not.
  std::vector<Matrix3d> covariances;  ///< By place; empty unless asked for.
};

/// Gauss-Newton steps, shortened where they overshoot. Not converged where they do not descend,
/// with the places before.
Descent descend_freely(NormalEquations* equations,
                       const std::vector<TravelResidual>& travels,
                       const LayoutOptions& options,
                       PlaceVector* places) {
  double cost = cost_of(*places, travels, options.outlier_sigmas);
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    if (!equations->expand_about(*places, options.outlier_sigmas)) {
      return {iteration, false, {}, {}};
    }
    const Eigen::VectorXd step = equations->step();
    const double gain = equations->predicted_gain(step);
    double share = 1.0;
    PlaceVector after = moved(*places, step, share);
    double cost_after = cost_of(after, travels, options.outlier_sigmas);
    while (!(cost_after <= cost * (1.0 + 1e-9) + kNoCost)) {
      share *= 0.5;
      if (share < kLeastShare) {
        return {iteration, false, {}, {}};
      }
      after = moved(*places, step, share);
      cost_after = cost_of(after, travels, options.outlier_sigmas);
    }
    *places = std::move(after);
    cost = cost_after;
    if (share == 1.0 && gain <= kLeastGain * cost + kNoCost) {
      return {iteration, true, {}, {}};
    }
  }
  return {options.max_iterations, false, {}, {}};
}

Descent descend(const std::vector<TravelResidual>& travels,
                const LayoutOptions& options,
                PlaceVector* places) {
  if (places->size() == 1) {
    return {0, true, {}, std::vector<Matrix3d>(options.covariances ? 1 : 0, Matrix3d::Zero())};
  }
  if (!std::isfinite(cost_of(*places, travels, options.outlier_sigmas))) {
    return {0, false, "layout: the start is too far off: its sum of squares is not finite", {}};
  }
  NormalEquations equations(static_cast<int>(places->size()), travels);
  Descent descent = descend_freely(&equations, travels, options, places);
  if (!descent.is_converged) {
    const Result<int> damped_steps = descend_damped(travels, options, places);
    descent.is_converged = damped_steps.ok();
    if (!damped_steps) {
      descent.reason = damped_steps.error().message;
      return descent;
    }
    descent.iterations += *damped_steps;
  }
  if (options.covariances) {
    if (!equations.expand_about(*places, 0.0)) {
      descent.is_converged = false;
      descent.reason = "layout: the curvature is singular";
      return descent;
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

/// The start in the frame of place 0, by the new numbers.
PlaceVector renumbered(const std::vector<Pose2>& start, const std::vector<int>& number) {
  PlaceVector numbered(start.size());
  const Pose2 T_first_frame = start.front().inverse();
  for (std::size_t place = 0; place < start.size(); ++place) {
    const Pose2 T_first_place = T_first_frame * start[place];
    numbered[at(number[place])] = {T_first_place.x(), T_first_place.y(), T_first_place.theta()};
  }
  return numbered;
}

}  // namespace

Result<LayoutAttempt> attempt_layout(int place_count,
                                     const std::vector<TravelConstraint>& travels,
                                     const LayoutOptions& options,
                                     const std::vector<Pose2>* start) {
  if (const Status sound = validate(options); !sound) {
    return sound.error();
  }
  if (const Status sound = validate_travels(place_count, travels); !sound) {
    return sound.error();
  }
  if (start != nullptr) {
    if (const Status sound = validate_start(place_count, *start); !sound) {
      return sound.error();
    }
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
  PlaceVector places =
      start != nullptr ? renumbered(*start, number) : linear_start(place_count, numbered);
  LayoutAttempt attempt;
  attempt.initial_chi2 = report(places, residuals, {}, number).chi2;
  const Descent descent = descend(residuals, options, &places);
  attempt.layout = report(places, residuals, descent, number);
  attempt.is_converged = descent.is_converged;
  attempt.reason = descent.reason;
  return attempt;
}

}  // namespace cairn
