#include "lpm/scan_refinement.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace cairn {
namespace {

using Vector3d = Eigen::Vector3d;

/// One round of descent. A wide loss first brings far points home; the narrow one does not let
/// them go on pulling.
struct Round {
  double loss_scale_in_sigmas = 0.0;
  int max_steps = 0;
  double converged_m = 0.0;
  double converged_rad = 0.0;
};
constexpr Round kWideRound{8.0, 15, 4e-3, 1e-3};
constexpr Round kNarrowRound{2.0, 15, 2e-4, 5e-5};
constexpr double kMaxDamping = 1e6;

/// What is laid on what.
struct Problem {
  const DistanceField& walls;
  const std::vector<SurfacePoint>& points;
  Pose2 prior_mean;
  Matrix3d prior_information;
  RefinementOptions options;
};

struct NormalEquations {
  Matrix3d hessian = Matrix3d::Zero();
  Vector3d gradient = Vector3d::Zero();
  Matrix3d information = Matrix3d::Zero();
  double cost = 0.0;
};

Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x() - b.x(), a.y() - b.y(), turn_between(b.theta(), a.theta())};
}

/// Squares of the returns around a pose; headings turn about the robot.
void add_returns(const Problem& problem,
                 const Pose2& pose,
                 double loss_scale_in_sigmas,
                 NormalEquations* sum) {
  const auto& [walls, points, prior_mean, prior_information, options] = problem;
  const double c = std::cos(pose.theta());
  const double s = std::sin(pose.theta());
  const double weight = options.independent_share / (options.hit_sigma_m * options.hit_sigma_m);
  const double scale_m = loss_scale_in_sigmas * options.hit_sigma_m;
  const double far_m = walls.geometry().cell_m * DistanceField::kReachCells;
  const double far_loss = std::log1p(far_m * far_m / (scale_m * scale_m));
  double loss = 0.0;
  const auto turned_by_pose = [c, s](const Vector2d& v) {
    return Vector2d(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  const auto jacobian_along = [](const Vector2d& way, const Vector2d& at) {
    return Vector3d(way.x(), way.y(), way.y() * at.x() - way.x() * at.y());
  };
  for (const SurfacePoint& point : points) {
    const Vector2d turned = turned_by_pose(point.p);
    const DistanceField::Sample wall = walls.sample(pose.translation() + turned);
    if (!wall.is_near) {
      loss += far_loss;
      continue;
    }
    const double share = wall.distance_m * wall.distance_m / (scale_m * scale_m);
    loss += std::log1p(share);
    const double robust = 1.0 / (1.0 + share);
    const Vector3d jacobian = jacobian_along(wall.gradient, turned);
    sum->hessian.noalias() += robust * jacobian * jacobian.transpose();
    sum->gradient += robust * wall.distance_m * jacobian;
    const Vector3d across = jacobian_along(turned_by_pose(point.normal), turned);
    sum->information.noalias() += robust * across * across.transpose();
  }
  sum->hessian *= weight;
  sum->information *= weight;
  sum->gradient *= weight;
  sum->cost += 0.5 * weight * scale_m * scale_m * loss;
}

NormalEquations equations_at(const Problem& problem,
                             const Pose2& pose,
                             double loss_scale_in_sigmas) {
  NormalEquations sum;
  add_returns(problem, pose, loss_scale_in_sigmas, &sum);
  const Vector3d deviation = difference(pose, problem.prior_mean);
  sum.hessian += problem.prior_information;
  sum.gradient += problem.prior_information * deviation;
  sum.cost += 0.5 * deviation.dot(problem.prior_information * deviation);
  return sum;
}

NormalEquations descend(const Problem& problem, const Round& round, Pose2* pose) {
  NormalEquations here = equations_at(problem, *pose, round.loss_scale_in_sigmas);
  double damping = 0.0;
  for (int step = 0; step < round.max_steps && damping < kMaxDamping; ++step) {
    Matrix3d damped = here.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector3d move = -damped.ldlt().solve(here.gradient);
    if (!move.allFinite()) {
      break;
    }
    const bool is_converged =
        move.head<2>().norm() < round.converged_m && std::abs(move.z()) < round.converged_rad;
    const Pose2 next(pose->x() + move.x(), pose->y() + move.y(), pose->theta() + move.z());
    const NormalEquations there = equations_at(problem, next, round.loss_scale_in_sigmas);
    if (there.cost <= here.cost) {
      damping = 0.0;
      *pose = next;
      here = there;
    } else {
      damping = damping == 0.0 ? 1.0 : 8.0 * damping;
    }
    if (is_converged) {
      break;
    }
  }
  return here;
}

}  // namespace

Refinement refine(const DistanceField& walls,
                  const std::vector<SurfacePoint>& points,
                  const GaussianPose& prior,
                  const Pose2& start,
                  const RefinementOptions& options) {
  const Problem problem{walls, points, prior.mean, prior.covariance.inverse(), options};
  Pose2 pose = start;
  descend(problem, kWideRound, &pose);
  const NormalEquations end = descend(problem, kNarrowRound, &pose);
  return {pose, end.information, options.hit_sigma_m, end.cost};
}

}  // namespace cairn
