#include "lpm/scan_continuity.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kReturns = 60;  // of a scan, spread evenly
constexpr double kMisjudged_rad = 0.2;

/// How close is close: it grows with the range, for half the step between turns, and more.
struct Closeness {
  double least_m;
  double by_range;
  double turn_step_rad;
};
constexpr Closeness kLoose{0.10, 0.05, 0.10};
constexpr Closeness kTight{0.08, 0.025, 0.05};

double share_close(const std::vector<Vector2d>& points,
                   const std::vector<Vector2d>& others,
                   const Pose2& T_others_points,
                   const Closeness& closeness) {
  const std::size_t stride = 1 + points.size() / kReturns;
  const double c = std::cos(T_others_points.theta());
  const double s = std::sin(T_others_points.theta());
  int seen = 0;
  int close = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Vector2d& p = points[i];
    const Vector2d there(T_others_points.x() + c * p.x() - s * p.y(),
                         T_others_points.y() + s * p.x() + c * p.y());
    const double close_m = closeness.least_m + closeness.by_range * p.norm();
    const auto is_close = [&](const Vector2d& other) {
      return (other - there).squaredNorm() <= close_m * close_m;
    };
    ++seen;
    close += std::any_of(others.begin(), others.end(), is_close) ? 1 : 0;
  }
  return static_cast<double>(close) / seen;
}

/// The largest over the turns by which the motion may be misjudged.
template <typename ShareAt>
double best_over_turns(const Pose2& T_before_now, double step_rad, ShareAt share_at) {
  const int steps = static_cast<int>(std::lround(kMisjudged_rad / step_rad));
  double best = 0.0;
  for (int i = -steps; i <= steps; ++i) {
    best = std::max(best, share_at(Pose2(T_before_now.x(), T_before_now.y(),
                                         T_before_now.theta() + i * step_rad)));
  }
  return best;
}

std::vector<Vector2d> points_of(const ScanBeams& beams) {
  std::vector<Vector2d> points(beams.returns().size());
  std::transform(beams.returns().begin(), beams.returns().end(), points.begin(),
                 [](const SurfacePoint& point) { return point.p; });
  return points;
}

}  // namespace

double continuity(const ScanBeams& now,
                  const std::vector<Vector2d>& before,
                  const Pose2& T_before_now) {
  const std::vector<Vector2d> points = points_of(now);
  if (points.empty() || before.empty()) {
    return 0.0;
  }
  return best_over_turns(T_before_now, kLoose.turn_step_rad, [&](const Pose2& T_before_points) {
    return share_close(points, before, T_before_points, kLoose);
  });
}

double mutual_continuity(const ScanBeams& now,
                         const std::vector<Vector2d>& before,
                         const Pose2& T_before_now) {
  const std::vector<Vector2d> points = points_of(now);
  if (points.empty() || before.empty()) {
    return 0.0;
  }
  return best_over_turns(T_before_now, kTight.turn_step_rad, [&](const Pose2& T_before_points) {
    return std::min(share_close(points, before, T_before_points, kTight),
                    share_close(before, points, T_before_points.inverse(), kTight));
  });
}

}  // namespace cairn
