#include "grid/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/distance_update.hpp"

namespace cairn {
namespace {

/// The part of a window that lies within the grid.
GridWindow clipped(const GridWindow& window, const GridGeometry& geometry) {
  const int x0 = std::clamp(window.lower.x, 0, geometry.width);
  const int y0 = std::clamp(window.lower.y, 0, geometry.height);
  const int x1 = std::clamp(window.lower.x + std::max(window.width, 0), x0, geometry.width);
  const int y1 = std::clamp(window.lower.y + std::max(window.height, 0), y0, geometry.height);
  return {{x0, y0}, x1 - x0, y1 - y0};
}

}  // namespace

GridWindow whole_window(const GridGeometry& geometry) {
  return {{0, 0}, geometry.width, geometry.height};
}

CellState DistanceTransform::state(Cell c) const {
  return window_.contains(c) ? state_[index_of(c)] : CellState::kUnknown;
}

std::int32_t DistanceTransform::squared_clearance_cells(Cell c) const {
  CAIRN_CHECK(window_.contains(c));
  return squared_cells_[index_of(c)];
}

double DistanceTransform::clearance_m(Cell c) const {
  if (!window_.contains(c)) {
    return 0.0;
  }
  const std::int32_t squared = squared_cells_[index_of(c)];
  return squared == kUnbounded ? std::numeric_limits<double>::infinity()
                               : geometry_.cell_m * std::sqrt(static_cast<double>(squared));
}

Cell DistanceTransform::basis_point(Cell c) const {
  CAIRN_CHECK(window_.contains(c));
  const CellOffset to = to_basis_[index_of(c)];
  return {c.x + to.dx, c.y + to.dy};
}

DistanceTransform distance_transform(const OccupancyGrid& grid, const GridWindow& window) {
  return DistanceUpdate::of_part(grid, clipped(window, grid.geometry()));
}

DistanceTransform distance_transform(const OccupancyGrid& grid) {
  return distance_transform(grid, whole_window(grid.geometry()));
}

DistanceTransform distance_transform(const StateGrid& grid) {
  DistanceUpdate update;
  update.update(grid, {});
  return update.distances();
}

}  // namespace cairn
