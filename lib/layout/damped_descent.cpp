#include "layout/damped_descent.hpp"

#include <deque>

#include <ceres/ceres.h>

namespace cairn {
namespace {

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

}  // namespace

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

}  // namespace cairn
