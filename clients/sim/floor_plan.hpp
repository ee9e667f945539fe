#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clients/sim/geometry.hpp"

namespace cairn::sim {

/// A cell of a floor plan; row 0 is the lowest, column 0 the leftmost.
struct Cell {
  int column = 0;
  int row = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Walls and free floor on a grid of square cells. Outside of the grid everything is wall.
class FloorPlan {
 public:
  FloorPlan() = default;
  /// All walls.
  /// @pre columns, rows >= 0, cell_m > 0
  FloorPlan(int columns, int rows, double cell_m);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }

  [[nodiscard]] bool contains(Cell cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns_ && cell.row < rows_;
  }
  [[nodiscard]] bool is_wall(Cell cell) const {
    return !contains(cell) || is_free_[index_of(cell)] == 0;
  }
  /// @pre contains(cell)
  void set_free(Cell cell) { is_free_[index_of(cell)] = 1; }

  /// The cell that holds the point; its lower and left borders belong to it.
  [[nodiscard]] Cell cell_of(Point point) const;
  [[nodiscard]] Point centre_of(Cell cell) const;

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }

  int columns_ = 0;
  int rows_ = 0;
  double cell_m_ = 1.0;
  std::vector<std::uint8_t> is_free_;
};

/// Distance from the point to the nearest wall, exact up to `limit_m` and `limit_m` beyond.
/// @return 0 inside a wall
[[nodiscard]] double clearance_m(const FloorPlan& plan, Point point, double limit_m);

/// Distance along a ray to the first wall, exact on the grid: the ray is followed from cell border
/// to cell border (Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing",
/// Eurographics 1987). A ray through the very corner of two walls that touch there may slip
/// through.
///
/// @return metres; 0 inside a wall; infinity where no wall is within `max_range_m`
[[nodiscard]] double cast_ray_m(const FloorPlan& plan,
                                Point origin,
                                double direction_rad,
                                double max_range_m);

}  // namespace cairn::sim
