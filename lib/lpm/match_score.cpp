#include "lpm/match_score.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kOnWall_m = 0.125;
constexpr double kBehindWall_m = 0.3;  // more is no inaccuracy
constexpr std::size_t kBeams = 180;    // spread evenly over the scan

bool goes_through_a_wall(const ScrollingMap& map, const Vector2d& from, const Vector2d& to) {
  const OccupancyGrid& grid = map.grid();
  const double length_m = (to - from).norm();
  const double step_m = 0.5 * grid.geometry().cell_m;
  for (double way_m = 0.0; way_m < length_m - kBehindWall_m; way_m += step_m) {
    const Vector2d p = from + way_m / length_m * (to - from);
    if (grid.state(grid.geometry().cell_at(p)) == CellState::kOccupied) {
      return true;
    }
  }
  return false;
}

}  // namespace

double sober_score(const ScrollingMap& map, const ScanBeams& beams, const Pose2& T_lpm_robot) {
  const OccupancyGrid& grid = map.grid();
  const double near_m = std::max(kOnWall_m, grid.geometry().cell_m);
  const std::size_t stride = 1 + beams.returns().size() / kBeams;
  int told = 0;
  int on_wall = 0;
  for (std::size_t i = 0; i < beams.returns().size(); i += stride) {
    const Vector2d to = T_lpm_robot * beams.returns()[i].p;
    const Cell cell = grid.geometry().cell_at(to);
    const bool is_on_wall = map.walls().distance_m(cell) <= near_m;
    on_wall += is_on_wall ? 1 : 0;
    told += is_on_wall || grid.state(cell) != CellState::kUnknown ||
                    goes_through_a_wall(map, T_lpm_robot * beams.origins()[i], to)
                ? 1
                : 0;
  }
  return told > 0 ? static_cast<double>(on_wall) / told : 0.0;
}

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
