#include "lpm/surface_refinement.hpp"

#include <algorithm>
#include <array>
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
constexpr Round kWideRound{4.0, 12, 4e-3, 1e-3};
constexpr Round kNarrowRound{1.0, 12, 6e-4, 2e-4};
constexpr std::size_t kPointsOfWideRound = 60;
constexpr double kLeastSpread_m = 0.01;
constexpr double kMaxDamping = 1e6;
constexpr double kOtherSide = 0.3;  // cosine between normals below which surfaces are not the same

struct Heading {
  double x = 1.0;
  double y = 0.0;
};
constexpr std::size_t kHeadings = 1024;

/// Unit vectors all around, each in the middle of its share of the turn.
constexpr std::array<Heading, kHeadings> make_headings() {
  constexpr Heading kStep{0.99998117528260111, 0.0061358846491544753};   // a turn / 1024
  constexpr Heading kFirst{0.99999529380957619, 0.0030679567629659762};  // half of that
  std::array<Heading, kHeadings> headings{};
  headings[0] = kFirst;
  for (std::size_t i = 1; i < kHeadings; ++i) {
    const Heading& last = headings[i - 1];
    headings[i] = {last.x * kStep.x - last.y * kStep.y, last.y * kStep.x + last.x * kStep.y};
  }
  return headings;
}
constexpr std::array<Heading, kHeadings> kHeadingTable = make_headings();

Vector2d heading_of(std::int16_t angle) {
  const Heading& heading = kHeadingTable[static_cast<std::uint16_t>(angle) / (65'536U / kHeadings)];
  return {heading.x, heading.y};
}

/// What is laid on what.
struct Problem {
  const ScrollingMap& map;
  const std::vector<SurfacePoint>& points;
  Pose2 prior_mean;
  Matrix3d prior_information;
  RefinementOptions options;
  std::size_t stride = 1;  // every so many-th point is looked at, and counts for the others
};

/// Sums over points of residuals and of their Jacobians, by entry: (x, y, theta).
struct Sums {
  double xx = 0.0, xy = 0.0, yy = 0.0, xt = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0;
  double loss = 0.0;
  double weights = 0.0;
  double squares = 0.0;  // of residuals

  void add(double weight, double error, const Vector2d& way, const Vector2d& arm) {
    const double turn = way.y() * arm.x() - way.x() * arm.y();
    const double wx = weight * way.x();
    const double wy = weight * way.y();
    const double wt = weight * turn;
    xx += wx * way.x();
    xy += wx * way.y();
    yy += wy * way.y();
    xt += wx * turn;
    yt += wy * turn;
    tt += wt * turn;
    x += wx * error;
    y += wy * error;
    t += wt * error;
    weights += weight;
    squares += weight * error * error;
  }
  void add(const Sums& other) {
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    xt += other.xt;
    yt += other.yt;
    tt += other.tt;
    x += other.x;
    y += other.y;
    t += other.t;
    loss += other.loss;
    weights += other.weights;
    squares += other.squares;
  }
  [[nodiscard]] Matrix3d matrix() const {
    Matrix3d m;
    m << xx, xy, xt, xy, yy, yt, xt, yt, tt;
    return m;
  }
};

struct NormalEquations {
  Matrix3d hessian = Matrix3d::Zero();
  Matrix3d information = Matrix3d::Zero();
  Vector3d gradient = Vector3d::Zero();
  double spread_m = 0.0;
  double cost = 0.0;
};

struct BothSums {
  Sums all;
  Sums facing;  // only of points on surfaces that are known to face some way: what they say is sure
};

/// Squares of the returns around a pose; headings turn about the robot.
BothSums sums_at(const Problem& problem, const Pose2& pose, double scale_m) {
  const GridGeometry& geometry = problem.map.grid().geometry();
  const DistanceField& walls = problem.map.walls();
  const double c = std::cos(pose.theta());
  const double s = std::sin(pose.theta());
  const double cell_m = geometry.cell_m;
  const double per_m = 1.0 / cell_m;
  const Vector2d origin = pose.translation() - geometry.origin_m;
  const double scale2 = scale_m * scale_m;
  BothSums sums;
  for (std::size_t i = 0; i < problem.points.size(); i += problem.stride) {
    const auto& [p, normal] = problem.points[i];
    const Vector2d arm(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    const Vector2d at = origin + arm;
    const double u = at.x() * per_m;
    const double v = at.y() * per_m;
    sums.all.loss += scale2;
    if (!(u >= 0.0 && v >= 0.0 && u < geometry.width && v < geometry.height)) {
      continue;
    }
    Cell wall;
    if (!walls.find_nearest({static_cast<int>(u), static_cast<int>(v)}, &wall)) {
      continue;
    }
    const SurfaceCell& surface = problem.map.surface(wall);
    constexpr double kFine = 1.0 / 256.0;
    const Vector2d off(at.x() - cell_m * (wall.x + 0.5 + kFine * surface.x),
                       at.y() - cell_m * (wall.y + 0.5 + kFine * surface.y));
    Vector2d way;
    double error = 0.0;
    if (surface.facing > 0) {
      way = heading_of(surface.angle);
      const Vector2d turned(c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y());
      const bool is_known = normal.x() != 0.0 || normal.y() != 0.0;
      if (is_known && way.dot(turned) < kOtherSide) {
        continue;
      }
      error = way.dot(off);
    } else {
      error = off.norm();
      way = error > 0.0 ? Vector2d(off / error) : Vector2d(1.0, 0.0);
    }
    const double square = error * error;
    const double share = scale2 / (scale2 + square);
    sums.all.loss -= scale2 * share;  // scale^2 square / (scale^2 + square) in all
    (surface.facing > 0 ? sums.facing : sums.all).add(share * share, error, way, arm);
  }
  sums.all.add(sums.facing);
  return sums;
}

NormalEquations equations_at(const Problem& problem,
                             const Pose2& pose,
                             double loss_scale_in_sigmas) {
  const RefinementOptions& options = problem.options;
  const double weight = options.independent_share * static_cast<double>(problem.stride) /
                        (options.hit_sigma_m * options.hit_sigma_m);
  const auto [sums, facing] = sums_at(problem, pose, loss_scale_in_sigmas * options.hit_sigma_m);
  const Vector3d deviation(pose.x() - problem.prior_mean.x(), pose.y() - problem.prior_mean.y(),
                           turn_between(problem.prior_mean.theta(), pose.theta()));
  const Vector3d pull = problem.prior_information * deviation;
  NormalEquations sum;
  sum.information = weight * facing.matrix();
  sum.hessian = weight * sums.matrix() + problem.prior_information;
  sum.gradient = weight * Vector3d(sums.x, sums.y, sums.t) + pull;
  sum.spread_m = facing.weights > 0.0
                     ? std::max(kLeastSpread_m, std::sqrt(facing.squares / facing.weights))
                     : options.hit_sigma_m;
  sum.cost = 0.5 * weight * sums.loss + 0.5 * deviation.dot(pull);
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
    if (is_converged) {
      *pose = next;  // so near that nothing looks any different from there
      break;
    }
    const NormalEquations there = equations_at(problem, next, round.loss_scale_in_sigmas);
    if (there.cost <= here.cost) {
      damping = 0.0;
      *pose = next;
      here = there;
    } else {
      damping = damping == 0.0 ? 1.0 : 8.0 * damping;
    }
  }
  return here;
}

}  // namespace

Refinement refine_on_surfaces(const ScrollingMap& map,
                              const std::vector<SurfacePoint>& points,
                              const GaussianPose& prior,
                              const Pose2& start,
                              const RefinementOptions& options) {
  Problem problem{map, points, prior.mean, prior.covariance.inverse(), options};
  Pose2 pose = start;
  problem.stride = 1 + points.size() / kPointsOfWideRound;
  descend(problem, kWideRound, &pose);
  problem.stride = 1;
  const NormalEquations end = descend(problem, kNarrowRound, &pose);
  return {pose, end.information, end.spread_m, end.cost};
}

}  // namespace cairn
