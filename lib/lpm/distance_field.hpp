#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// For every cell the distance to the nearest wall cell, as far as a reach of `kReachCells`: what
/// scans are matched to. Kept up to date cell by cell, since few cells change with a scan.
///
/// Source: the likelihood field of Thrun, Burgard and Fox, "Probabilistic Robotics", Sec. 6.4.
class DistanceField {
 public:
  static constexpr int kReachCells = 10;
  static constexpr std::uint8_t kFar = kReachCells * kReachCells + 1;  ///< No wall within reach.

  /// Distance and its gradient at a point between the centres of cells.
  struct Sample {
    double distance_m = 0.0;
    Vector2d gradient = Vector2d::Zero();
    bool is_near = false;  ///< A wall is within reach.
  };

  explicit DistanceField(const GridGeometry& geometry);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  /// Squared distance in cells, kFar where there is no wall within reach or outside of the field.
  [[nodiscard]] std::uint8_t squared_cells(Cell c) const {
    return geometry_.contains(c) ? squared_[geometry_.index_of(c)] : kFar;
  }
  [[nodiscard]] const std::vector<std::uint8_t>& squared() const { return squared_; }
  /// Metres from a cell to the nearest wall, cut at the reach.
  [[nodiscard]] double distance_m(Cell c) const { return distance_m_[squared_cells(c)]; }
  /// Bilinear between cell centres.
  [[nodiscard]] Sample sample(const Vector2d& p) const;

  /// A cell has become a wall.
  /// @pre geometry().contains(wall)
  void add_wall(Cell wall);
  /// The walls between two corners, both included, have changed in any way: computes anew what
  /// depends on them.
  void renew(const OccupancyGrid& grid, Cell low, Cell high);
  /// Moves the window by whole cells; what comes in is without walls.
  void shift(Cell by);
  void clear();

 private:
  void lower_around(Cell wall, Cell low, Cell high);

  GridGeometry geometry_;
  std::vector<std::uint8_t> squared_;
  std::array<double, kFar + 1> distance_m_{};
};

/// Moves the content of a row-major window by whole cells: the value at `c` goes to `c - by`. What
/// comes in is `fill`.
template <typename T>
void shift_cells(std::vector<T>* cells, int width, int height, Cell by, T fill) {
  const std::vector<T> old = *cells;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int from_x = x + by.x;
      const int from_y = y + by.y;
      const bool is_inside = from_x >= 0 && from_y >= 0 && from_x < width && from_y < height;
      const auto at = [width](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column);
      };
      (*cells)[at(x, y)] = is_inside ? old[at(from_x, from_y)] : fill;
    }
  }
}

}  // namespace cairn
