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

/// Looks for the nearest cells that are not free to the right and to the left of a direction.
struct SideSearch {
  const DistanceTransform& distances;
  Cell at;
  Vector2d along;
  std::array<Cell, 2> best;
  std::array<int, 2> best_squared{kNotFound, kNotFound};

  static constexpr int kNotFound = std::numeric_limits<int>::max();

  [[nodiscard]] int farther_squared() const { return std::max(best_squared[0], best_squared[1]); }

  void look_at_row(int dy, int reach) {
    const GridWindow& window = distances.window();
    const int y = at.y + dy;
    if (y < window.lower.y || y >= window.lower.y + window.height) {
      return;
    }
    const int first = std::max(at.x - reach, window.lower.x);
    const int last = std::min(at.x + reach, window.lower.x + window.width - 1);
    const CellState* const state = distances.states().data() +
                                   std::ptrdiff_t{y - window.lower.y} * window.width -
                                   window.lower.x;
    for (int x = first; x <= last; ++x) {
      if (state[x - window.lower.x] != CellState::kFree) {
        take({x, y}, x - at.x, dy);
      }
    }
  }

  void take(Cell c, int dx, int dy) {
    const Vector2d to(dx, dy);
    const double left = along.x() * to.y() - along.y() * to.x();
    // Within 45 degrees of straight across: what lies ahead or behind is no side.
    if (std::abs(left) < std::abs(along.dot(to))) {
      return;
    }
    const std::size_t side = left < 0.0 ? 0 : 1;
    const int squared = dx * dx + dy * dy;
    // Of equals the lowest counts, then the leftmost.
    const bool is_nearer = squared < best_squared[side] ||
                           (squared == best_squared[side] &&
                            (c.y < best[side].y || (c.y == best[side].y && c.x < best[side].x)));
    if (is_nearer) {
      best_squared[side] = squared;
      best[side] = c;
    }
  }
};

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
  // The axis is thin but not exact: the farther of the two points may lie some cells farther.
  const int reach = static_cast<int>(std::min(1.5 * clearance + 3.0, 1000.0));
  SideSearch search{distances, at, along, {at, at}};
  // Rows farther away than what was found on both sides need no look.
  for (int rows = 0; rows <= reach && rows * rows <= search.farther_squared(); ++rows) {
    search.look_at_row(-rows, reach);
    if (rows > 0) {
      search.look_at_row(rows, reach);
    }
  }
  return search.best;
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
