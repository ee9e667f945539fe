#include "grid/critical_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/validator.hpp"
#include "grid/axis_graph.hpp"

namespace cairn {
namespace {

/// Direction of the edge around a position, over a few cells, as single steps have but 8
/// directions.
Vector2d direction_at(const AxisEdge& edge, std::size_t position) {
  constexpr std::size_t kReach = 4;
  const Cell a = edge.cells[position > kReach ? position - kReach : 0];
  const Cell b = edge.cells[std::min(position + kReach, edge.cells.size() - 1)];
  return {b.x - a.x, b.y - a.y};
}

/// Whether clearance rises by the drop within reach in one direction, without falling below that of
/// the point before.
bool rises(const AxisEdge& edge,
           std::size_t position,
           bool forward,
           double cell_m,
           const CriticalPointOptions& options) {
  const double least_m = edge.clearance_m[position];
  double travelled_m = 0.0;
  std::size_t i = position;
  while (travelled_m <= options.near_m && (forward ? i + 1 < edge.cells.size() : i > 0)) {
    const std::size_t next = forward ? i + 1 : i - 1;
    travelled_m += length_m(edge, i, next, cell_m);
    // Of equal minima the first counts.
    const double clearance_m = edge.clearance_m[next];
    if (forward ? clearance_m < least_m : clearance_m <= least_m) {
      return false;
    }
    if (clearance_m >= least_m + options.drop_m) {
      return true;
    }
    i = next;
  }
  return false;
}

}  // namespace

Status validate(const CriticalPointOptions& options) {
  return Validator("critical_points")
      .positive("near_m", options.near_m)
      .positive("drop_m", options.drop_m)
      .status();
}

std::array<Cell, 2> basis_points_at(const DistanceTransform& distances,
                                    const AxisEdge& edge,
                                    std::size_t position) {
  const Cell at = edge.cells[position];
  const Vector2d along = direction_at(edge, position);
  const double clearance = edge.clearance_m[position] / distances.geometry().cell_m;
  std::array<Cell, 2> best{at, at};
  std::array<double, 2> best_squared{std::numeric_limits<double>::max(),
                                     std::numeric_limits<double>::max()};
  // The axis is thin but not exact: the farther of the two points may lie some cells farther.
  const int reach = static_cast<int>(std::min(1.5 * clearance + 3.0, 1000.0));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c{at.x + dx, at.y + dy};
      if (!distances.window().contains(c) || distances.state(c) == CellState::kFree) {
        continue;
      }
      const Vector2d to(dx, dy);
      const double left_m = along.x() * to.y() - along.y() * to.x();
      // Within 45 degrees of straight across: what lies ahead or behind is no side.
      if (std::abs(left_m) < std::abs(along.dot(to))) {
        continue;
      }
      const std::size_t side = left_m < 0.0 ? 0 : 1;
      if (to.squaredNorm() < best_squared[side]) {
        best_squared[side] = to.squaredNorm();
        best[side] = c;
      }
    }
  }
  return best;
}

std::vector<CriticalPoint> critical_points(const DistanceTransform& distances,
                                           const MedialAxis& axis,
                                           const CriticalPointOptions& options) {
  std::vector<CriticalPoint> result;
  const double cell_m = distances.geometry().cell_m;
  for (std::size_t e = 0; e < axis.edges.size(); ++e) {
    const AxisEdge& edge = axis.edges[e];
    for (std::size_t i = 0; i < edge.cells.size(); ++i) {
      const bool is_minimum =
          rises(edge, i, true, cell_m, options) && rises(edge, i, false, cell_m, options);
      if (is_minimum) {
        result.push_back(
            {e, i, edge.cells[i], edge.clearance_m[i], basis_points_at(distances, edge, i)});
      }
    }
  }
  return result;
}

}  // namespace cairn
