#include "lpm/match_score.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

constexpr double kBehindWall_m = 0.4;  // more is no inaccuracy
constexpr double kFacing = 0.5;        // of the beam against the wall: not along it
constexpr int kLeastReturns = 3;       // that a wall was seen by
constexpr std::size_t kBeams = 60;     // spread over the scan, that are asked

/// @param from, to in cells
bool goes_through_wall(const ScrollingMap& map, const Vector2d& from, const Vector2d& to) {
  const GridGeometry& geometry = map.grid().geometry();
  const double length = (to - from).norm();
  const double last = length - kBehindWall_m / geometry.cell_m;
  const Vector2d along = (to - from) / length;
  for (double way = 0.0; way < last;) {
    const Vector2d p = from + way * along;
    const Cell cell{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
    const std::uint8_t squared_cells = map.walls().squared_cells(cell);
    if (squared_cells == 0) {
      const SurfaceCell& wall = map.surface(cell);
      const double angle = wall.angle * (kPi / 32768.0);
      if (wall.facing >= kLeastReturns &&
          along.dot(Vector2d(std::cos(angle), std::sin(angle))) < -kFacing) {
        return true;
      }
    }
    // A wall is no nearer than that, as cells are told from centre to centre.
    way += std::max(std::sqrt(static_cast<double>(squared_cells)) - 1.0, 0.5);
  }
  return false;
}

}  // namespace

double share_through_walls(const ScrollingMap& map,
                           const ScanBeams& beams,
                           const Pose2& T_lpm_robot) {
  const GridGeometry& geometry = map.grid().geometry();
  const double c = std::cos(T_lpm_robot.theta()) / geometry.cell_m;
  const double s = std::sin(T_lpm_robot.theta()) / geometry.cell_m;
  const Vector2d origin = (T_lpm_robot.translation() - geometry.origin_m) / geometry.cell_m;
  const auto cells = [&](const Vector2d& p) {
    return Vector2d(origin.x() + c * p.x() - s * p.y(), origin.y() + s * p.x() + c * p.y());
  };
  const std::size_t stride = 1 + beams.returns().size() / kBeams;
  int asked = 0;
  int through = 0;
  for (std::size_t i = 0; i < beams.returns().size(); i += stride) {
    ++asked;
    through +=
        goes_through_wall(map, cells(beams.origins()[i]), cells(beams.returns()[i].p)) ? 1 : 0;
  }
  return asked > 0 ? static_cast<double>(through) / asked : 0.0;
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
