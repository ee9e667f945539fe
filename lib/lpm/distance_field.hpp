#pragma once

#include <array>
#include <cstdint>

#include "grid/occupancy_grid.hpp"
#include "lpm/cell_ring.hpp"

namespace cairn {

/// For every cell the wall cell nearest to it, as far as a reach of `kReachCells`: what scans are
/// matched to. Kept up to date cell by cell, since few cells change with a scan. It depends on
/// where walls are, and not on the order in which they came and went.
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
    return geometry_.contains(c) ? squared_of_[rank_of(nearest_[c])] : kFar;
  }
  /// Metres from a cell to the nearest wall, cut at the reach.
  [[nodiscard]] double distance_m(Cell c) const { return distance_m_[squared_cells(c)]; }
  /// The nearest wall cell; of several that are as near always the same.
  /// @pre geometry().contains(c)
  /// @return false where no wall is within reach, or it lies outside of the window
  [[nodiscard]] bool find_nearest(Cell c, Cell* wall) const {
    const std::int16_t nearest = nearest_[c];
    if (nearest == kNone) {
      return false;
    }
    const int code = nearest & kOffsetMask;
    *wall = {c.x + offset_x_[static_cast<std::size_t>(code)],
             c.y + offset_y_[static_cast<std::size_t>(code)]};
    return geometry_.contains(*wall);  // the window may have left it behind
  }
  /// What a table says of the squared distances of cells side by side in a row, from `first` on.
  /// @pre the cells lie within the field
  void look_up(Cell first,
               int count,
               const std::array<std::uint8_t, kFar + 1>& by_squared,
               std::uint8_t* values) const;
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
  void clear() { nearest_.clear(); }
  [[nodiscard]] std::size_t memory_bytes() const { return nearest_.memory_bytes(); }

 private:
  // A cell holds in one number how far the nearest wall is, as the rank of its squared distance,
  // and below that where it is: the nearer wall is the lower number, so that many cells are
  // brought up to date at once.
  static constexpr int kSide = 2 * kReachCells + 1;
  static constexpr int kOffsetBits = 9;
  static constexpr int kOffsetMask = (1 << kOffsetBits) - 1;
  static constexpr std::int16_t kNone = 0x7fff;
  static constexpr std::size_t kRanks = 64;

  [[nodiscard]] static std::size_t rank_of(std::int16_t nearest) {
    return static_cast<std::size_t>(nearest >> kOffsetBits);
  }
  void lower_around(Cell wall, Cell low, Cell high);

  GridGeometry geometry_;
  CellRing<std::int16_t> nearest_;
  std::array<std::int16_t, kSide * kSide> stamp_{};  // what a wall says to the cells around it
  std::array<std::int8_t, 1 << kOffsetBits> offset_x_{};
  std::array<std::int8_t, 1 << kOffsetBits> offset_y_{};
  std::array<std::uint8_t, kRanks> squared_of_{};
  std::array<double, kFar + 1> distance_m_{};
};

}  // namespace cairn
