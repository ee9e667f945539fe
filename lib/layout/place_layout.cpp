#include "layout/place_layout.hpp"

#include <cmath>
#include <deque>
#include <optional>
#include <string>

#include <ceres/ceres.h>

#include "base/validator.hpp"
#include "layout/displacement.hpp"
#include "layout/linear_start.hpp"
#include "layout/normal_equations.hpp"
#include "layout/travel_residual.hpp"
#include "layout/travel_tree.hpp"

namespace cairn {
namespace {

constexpr int kMaxPlaces = 1'000'000;
/// A sum of squares that is nothing but rounding.
constexpr double kNoCost = 1e-12;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// (15): one factor F of G(chi), as a whitened residual. A heading is any angle: the residual is
/// wrapped, so that adding a step to it is a retraction of the circle and needs no other manifold.
class TravelCost final : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit TravelCost(const TravelResidual* travel) : travel_(travel) {}

  bool Evaluate(const double* const* poses, double* residual, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> from(poses[0]);
    const Eigen::Map<const Eigen::Vector3d> to(poses[1]);
    Matrix3d by_from;
    Matrix3d by_to;
    Eigen::Map<Eigen::Vector3d>(residual).noalias() = travel_->at(from, to, &by_from, &by_to);
    if (jacobians != nullptr) {
      copy_by_rows(by_from, jacobians[0]);
      copy_by_rows(by_to, jacobians[1]);
    }
    return true;
  }

 private:
  static void copy_by_rows(const Matrix3d& matrix, double* rows) {
    if (rows != nullptr) {  // Null for a place that is held.
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{rows} = matrix;
    }
  }

  const TravelResidual* travel_;
};

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

double chi2_at(const PlaceVector& places, const std::vector<TravelResidual>& travels) {
  double chi2 = 0.0;
  for (const TravelResidual& travel : travels) {
    chi2 += travel.at(places[at(travel.from)], places[at(travel.to)]).squaredNorm();
  }
  return chi2;
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

ceres::Solver::Options solver_options(const LayoutOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-9;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  return solver;
}

/// Gauss-Newton steps for as long as they descend.
/// @return the number of steps; none where a step did not descend, with the places before it
std::optional<int> descend_freely(NormalEquations* equations,
                                  const std::vector<TravelResidual>& travels,
                                  const LayoutOptions& options,
                                  PlaceVector* places) {
  double cost = cost_of(*places, travels, options.outlier_sigmas);
  for (int step = 1; step <= options.max_iterations; ++step) {
    if (!equations->expand_about(*places, options.outlier_sigmas)) {
      return std::nullopt;
    }
    PlaceVector moved = equations->after_step(*places);
    const double moved_cost = cost_of(moved, travels, options.outlier_sigmas);
    if (!(moved_cost <= cost * (1.0 + 1e-9) + kNoCost)) {
      return std::nullopt;
    }
    *places = std::move(moved);
    if (cost - moved_cost <= 1e-9 * cost + kNoCost) {
      return step;
    }
    cost = moved_cost;
  }
  return std::nullopt;
}

/// Moves the places to the nearest least sum of squares where Gauss-Newton steps overshoot.
Result<int> descend_damped(const std::vector<TravelResidual>& travels,
                           const LayoutOptions& options,
                           PlaceVector* places) {
  ceres::HuberLoss loss(options.outlier_sigmas > 0.0 ? options.outlier_sigmas : 1.0);
  std::deque<TravelCost> costs;  // Ceres keeps their addresses.
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem problem(ownership);
  for (Eigen::Vector3d& place : *places) {
    problem.AddParameterBlock(place.data(), 3);
  }
  problem.SetParameterBlockConstant(places->front().data());
  for (const TravelResidual& travel : travels) {
    if (travel.from != travel.to) {  // A loop path says nothing of where its place lies.
      problem.AddResidualBlock(&costs.emplace_back(&travel),
                               options.outlier_sigmas > 0.0 ? &loss : nullptr,
                               (*places)[at(travel.from)].data(), (*places)[at(travel.to)].data());
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(options), &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) {
    return Error{ErrorCode::kNotConverged, "layout: " + summary.message};
  }
  return static_cast<int>(summary.iterations.size());
}

PlaceLayout report(const PlaceVector& places, const std::vector<TravelResidual>& travels) {
  PlaceLayout layout;
  for (const Eigen::Vector3d& place : places) {
    layout.T_global_place.emplace_back(place.x(), place.y(), place.z());
  }
  for (const TravelResidual& travel : travels) {
    const double chi2 = travel.at(places[at(travel.from)], places[at(travel.to)]).squaredNorm();
    layout.chi2_of_travel.push_back(chi2);
    layout.chi2 += chi2;
    layout.log_likelihood -= 0.5 * (chi2 + travel.log_det_covariance + 3.0 * std::log(2.0 * kPi));
  }
  return layout;
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
  std::vector<TravelResidual> residuals;
  residuals.reserve(travels.size());
  for (const TravelConstraint& travel : travels) {
    residuals.push_back(residual_of(travel));
  }
  std::optional<PlaceVector> places = start_from(previous, place_count, travels);
  // Beyond three standard deviations in the mean, the earlier layout says little: start anew.
  if (!places || chi2_at(*places, residuals) > 27.0 * static_cast<double>(travels.size())) {
    places = linear_start(place_count, travels);
  }
  if (place_count == 1) {
    PlaceLayout layout = report(*places, residuals);
    layout.covariances.resize(options.covariances ? 1 : 0, Matrix3d::Zero());
    return layout;
  }
  NormalEquations equations(place_count, residuals);
  std::optional<int> iterations = descend_freely(&equations, residuals, options, &*places);
  if (!iterations) {
    const Result<int> damped = descend_damped(residuals, options, &*places);
    if (!damped) {
      return damped.error();
    }
    iterations = *damped;
  }
  PlaceLayout layout = report(*places, residuals);
  layout.iterations = *iterations;
  if (options.covariances && equations.expand_about(*places, 0.0)) {
    layout.covariances = equations.place_covariances();
  }
  return layout;
}

}  // namespace cairn
