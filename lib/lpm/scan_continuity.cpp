#include "lpm/scan_continuity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kReturns = 60;  // of the later scan, spread evenly
constexpr double kClose_m = 0.10;
constexpr double kCloseByRange = 0.05;  // half the step between turns, and as much again
constexpr std::array<double, 5> kTurns_rad{-0.2, -0.1, 0.0, 0.1, 0.2};

}  // namespace

double continuity(const ScanBeams& now,
                  const std::vector<Vector2d>& before,
                  const Pose2& T_before_now) {
  const std::vector<SurfacePoint>& returns = now.returns();
  if (returns.empty() || before.empty()) {
    return 0.0;
  }
  const std::size_t stride = 1 + returns.size() / kReturns;
  double best = 0.0;
  for (const double turn_rad : kTurns_rad) {
    const double angle_rad = T_before_now.theta() + turn_rad;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    int seen = 0;
    int close = 0;
    for (std::size_t i = 0; i < returns.size(); i += stride) {
      const Vector2d& p = returns[i].p;
      const Vector2d there(T_before_now.x() + c * p.x() - s * p.y(),
                           T_before_now.y() + s * p.x() + c * p.y());
      const double close_m = kClose_m + kCloseByRange * p.norm();
      const auto is_close = [&](const Vector2d& other) {
        return (other - there).squaredNorm() <= close_m * close_m;
      };
      ++seen;
      close += std::any_of(before.begin(), before.end(), is_close) ? 1 : 0;
    }
    best = std::max(best, static_cast<double>(close) / seen);
  }
  return best;
}

}  // namespace cairn
