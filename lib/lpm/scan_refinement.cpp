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
                 const std::vector<Vector2d>& p_robot,
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
  for (const Vector2d& p : p_robot) {
    const Vector2d turned(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    const DistanceField::Sample wall = walls.sample(pose.translation() + turned);
    if (!wall.is_near) {
      loss += far_loss;
      continue;
    }
    const double share = wall.distance_m * wall.distance_m / (scale_m * scale_m);
    loss += std::log1p(share);
    const double robust = 1.0 / (1.0 + share);
    const Vector3d jacobian(wall.gradient.x(), wall.gradient.y(),
                            wall.gradient.y() * turned.x() - wall.gradient.x() * turned.y());
    sum->information.noalias() += robust * jacobian * jacobian.transpose();
    sum->gradient += robust * wall.distance_m * jacobian;
  }
  sum->information *= weight;
  sum->gradient *= weight;
  sum->hessian += sum->information;
  sum->cost += 0.5 * weight * scale_m * scale_m * loss;
}

NormalEquations equations_at(const DistanceField& walls,
                             const std::vector<Vector2d>& p_robot,
                             const GaussianPose& prior,
                             const Pose2& pose,
                             const RefinementOptions& options) {
  NormalEquations sum;
  add_returns(walls, p_robot, pose, options, &sum);
  const Matrix3d information = prior.covariance.inverse();
  const Vector3d deviation = difference(pose, prior.mean);
  sum.hessian += information;
  sum.gradient += information * deviation;
  sum.cost += 0.5 * deviation.dot(information * deviation);
  return sum;
}

}  // namespace

Refinement refine(const DistanceField& walls,
                  const std::vector<Vector2d>& p_robot,
                  const GaussianPose& prior,
                  const Pose2& start,
                  const RefinementOptions& options) {
  Pose2 pose = start;
  NormalEquations here = equations_at(walls, p_robot, prior, pose, options);
  double damping = 0.0;
  for (int step = 0; step < kMaxSteps && damping < kMaxDamping; ++step) {
    Matrix3d damped = here.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector3d move = -damped.ldlt().solve(here.gradient);
    if (!move.allFinite()) {
      break;
    }
    const Pose2 next(pose.x() + move.x(), pose.y() + move.y(), pose.theta() + move.z());
    const NormalEquations there = equations_at(walls, p_robot, prior, next, options);
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
