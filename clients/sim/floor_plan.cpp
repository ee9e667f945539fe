#include "clients/sim/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A ray's way along one axis, measured along the ray.
struct AxisWalk {
  int step = 0;
  double next_border_m = kInfinity;
  double between_borders_m = kInfinity;
};

AxisWalk walk_of(double origin_m, double direction, int cell, double cell_m) {
  if (direction == 0.0) {
    return {};
  }
  const int step = direction > 0.0 ? 1 : -1;
  const double border_m = cell_m * (direction > 0.0 ? cell + 1 : cell);
  return {step, (border_m - origin_m) / direction, cell_m / std::abs(direction)};
}

/// Distance from the point to the square of the cell.
double distance_to_cell_m(const FloorPlan& plan, Point point, Cell cell) {
  const Point centre = plan.centre_of(cell);
  const double half_m = 0.5 * plan.cell_m();
  const double dx_m = std::max(0.0, std::abs(point.x_m - centre.x_m) - half_m);
  const double dy_m = std::max(0.0, std::abs(point.y_m - centre.y_m) - half_m);
  return std::hypot(dx_m, dy_m);
}

}  // namespace

FloorPlan::FloorPlan(int columns, int rows, double cell_m)
    : columns_(columns),
      rows_(rows),
      cell_m_(cell_m),
      is_free_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}

Cell FloorPlan::cell_of(Point point) const {
  // Far outside is as good as just outside, and fits an int.
  const auto index = [this](double coordinate_m, int count) {
    return static_cast<int>(std::clamp(std::floor(coordinate_m / cell_m_), -1.0, 1.0 * count));
  };
  return {index(point.x_m, columns_), index(point.y_m, rows_)};
}

Point FloorPlan::centre_of(Cell cell) const {
  return {(cell.column + 0.5) * cell_m_, (cell.row + 0.5) * cell_m_};
}

double clearance_m(const FloorPlan& plan, Point point, double limit_m) {
  if (plan.is_wall(plan.cell_of(point))) {
    return 0.0;  // Also far outside, where no cell of the plan is near.
  }
  const Cell low = plan.cell_of({point.x_m - limit_m, point.y_m - limit_m});
  const Cell high = plan.cell_of({point.x_m + limit_m, point.y_m + limit_m});
  double nearest_m = limit_m;
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      if (plan.is_wall({column, row})) {
        nearest_m = std::min(nearest_m, distance_to_cell_m(plan, point, {column, row}));
      }
    }
  }
  return nearest_m;
}

double cast_ray_m(const FloorPlan& plan, Point origin, double direction_rad, double max_range_m) {
  const double dx = std::cos(direction_rad);
  const double dy = std::sin(direction_rad);
  Cell cell = plan.cell_of(origin);
  AxisWalk x = walk_of(origin.x_m, dx, cell.column, plan.cell_m());
  AxisWalk y = walk_of(origin.y_m, dy, cell.row, plan.cell_m());
  double travelled_m = 0.0;
  while (!plan.is_wall(cell)) {
    if (x.next_border_m < y.next_border_m) {
      travelled_m = x.next_border_m;
      x.next_border_m += x.between_borders_m;
      cell.column += x.step;
    } else {
      travelled_m = y.next_border_m;
      y.next_border_m += y.between_borders_m;
      cell.row += y.step;
    }
    if (travelled_m > max_range_m) {
      return kInfinity;
    }
  }
  return travelled_m;
}

}  // namespace cairn::sim
