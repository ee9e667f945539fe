#include "lpm/match_score.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

void judge(const ScrollingMap& map,
           const std::vector<SurfacePoint>& returns,
           double on_wall_m,
           ScanMatch* match) {
  const GridGeometry& geometry = map.grid().geometry();
  const double near_m = std::max(on_wall_m, geometry.cell_m);
  const Pose2& pose = match->fit.T_lpm_robot;
  const double c = std::cos(pose.theta());  // once, and not for every return
  const double s = std::sin(pose.theta());
  int known = 0;
  int on_wall = 0;
  for (const SurfacePoint& point : returns) {
    const Cell cell = geometry.cell_at({pose.x() + c * point.p.x() - s * point.p.y(),
                                        pose.y() + s * point.p.x() + c * point.p.y()});
    const bool is_on_wall = map.walls().distance_m(cell) <= near_m;
    on_wall += is_on_wall ? 1 : 0;
    known += is_on_wall || map.grid().state(cell) != CellState::kUnknown ? 1 : 0;
  }
  match->score = known > 0 ? static_cast<double>(on_wall) / known : 0.0;
  match->known_share =
      returns.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(returns.size());
}

}  // namespace cairn
