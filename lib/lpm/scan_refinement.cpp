#include "lpm/scan_refinement.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace cairn {
namespace {

using Vector3d = Eigen::Vector3d;

constexpr int kMaxSteps = 15;
constexpr double kConverged_m = 1e-4;
constexpr double kConverged_rad = 2e-5;
constexpr double kLossScaleInSigmas = 2.0;
constexpr double kMaxDamping = 1e6;

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
void add_returns(const DistanceField& walls,
                 const std::vector<SurfacePoint>& points,
                 const Pose2& pose,
                 const RefinementOptions& options,
                 NormalEquations* sum) {
  const double c = std::cos(pose.theta());
  const double s = std::sin(pose.theta());
  const double weight = options.independent_share / (options.hit_sigma_m * options.hit_sigma_m);
  const double scale_m = kLossScaleInSigmas * options.hit_sigma_m;
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

NormalEquations equations_at(const DistanceField& walls,
                             const std::vector<SurfacePoint>& points,
                             const GaussianPose& prior,
                             const Pose2& pose,
                             const RefinementOptions& options) {
  NormalEquations sum;
  add_returns(walls, points, pose, options, &sum);
  const Matrix3d information = prior.covariance.inverse();
  const Vector3d deviation = difference(pose, prior.mean);
  sum.hessian += information;
  sum.gradient += information * deviation;
  sum.cost += 0.5 * deviation.dot(information * deviation);
  return sum;
}

}  // namespace

Refinement refine(const DistanceField& walls,
                  const std::vector<SurfacePoint>& points,
                  const GaussianPose& prior,
                  const Pose2& start,
                  const RefinementOptions& options) {
  Pose2 pose = start;
  NormalEquations here = equations_at(walls, points, prior, pose, options);
  double damping = 0.0;
  for (int step = 0; step < kMaxSteps && damping < kMaxDamping; ++step) {
    Matrix3d damped = here.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector3d move = -damped.ldlt().solve(here.gradient);
    if (!move.allFinite()) {
      break;
    }
    const Pose2 next(pose.x() + move.x(), pose.y() + move.y(), pose.theta() + move.z());
    const NormalEquations there = equations_at(walls, points, prior, next, options);
    if (there.cost > here.cost) {
      damping = damping == 0.0 ? 1.0 : 8.0 * damping;
      continue;
    }
    damping = 0.0;
    pose = next;
    here = there;
    if (move.head<2>().norm() < kConverged_m && std::abs(move.z()) < kConverged_rad) {
      break;
    }
  }
  return {pose, here.information, here.cost};
}

}  // namespace cairn
