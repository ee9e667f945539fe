#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "grid/state_grid.hpp"

namespace cairn {

/// A rectangle of cells of a grid.
struct GridWindow {
  Cell lower;  ///< Lower left cell.
  int width = 0;
  int height = 0;

  [[nodiscard]] bool contains(Cell c) const {
    return c.x >= lower.x && c.y >= lower.y && c.x < lower.x + width && c.y < lower.y + height;
  }
};

/// All cells of a grid.
[[nodiscard]] GridWindow whole_window(const GridGeometry& geometry);

/// From a cell to another one.
struct CellOffset {
  std::int32_t dx = 0;
  std::int32_t dy = 0;
  friend bool operator==(const CellOffset&, const CellOffset&) = default;
};

/// For every free cell the nearest cell that is not free (its basis point) and the distance to it
/// (its clearance).
///
/// Both are the terms of Thrun and Bücken, AAAI 1996, "Topological Maps", step 2. A cell of unknown
/// state bounds free space as an occupied one does, and can be told from it by `basis_state`; the
/// border of the window bounds nothing. Of several nearest cells the leftmost counts, then the
/// lowest, so the field depends on the cells alone. Cells are named as in the grid that was
/// transformed.
class DistanceTransform {
 public:
  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] const GridWindow& window() const { return window_; }

  /// Of the cell itself; unknown outside of the window.
  [[nodiscard]] CellState state(Cell c) const;

  /// Squared distance to the basis point, in cells; 0 for a cell that is not free; kUnbounded where
  /// nothing in the window bounds free space.
  /// @pre window().contains(c)
  [[nodiscard]] std::int32_t squared_clearance_cells(Cell c) const;

  /// The same for all cells of the window, row by row from below.
  [[nodiscard]] const std::vector<std::int32_t>& squared_clearances_cells() const {
    return squared_cells_;
  }

  /// From the centre of the cell to the centre of its basis point, in metres; infinity where
  /// nothing bounds free space; 0 outside of the window.
  [[nodiscard]] double clearance_m(Cell c) const;

  /// The nearest cell that is not free; the cell itself where it is not free, or unbounded.
  /// @pre window().contains(c)
  [[nodiscard]] Cell basis_point(Cell c) const;

  /// The way to the basis point, for all cells of the window.
  [[nodiscard]] const std::vector<CellOffset>& basis_offsets() const { return to_basis_; }

  /// For all cells of the window.
  [[nodiscard]] const std::vector<CellState>& states() const { return state_; }

  static constexpr std::int32_t kUnbounded = INT32_MAX;

 private:
  friend class DistanceUpdate;

  [[nodiscard]] std::size_t index_of(Cell c) const {
    return static_cast<std::size_t>(c.y - window_.lower.y) *
               static_cast<std::size_t>(window_.width) +
           static_cast<std::size_t>(c.x - window_.lower.x);
  }

  GridGeometry geometry_;
  GridWindow window_;
  std::vector<CellState> state_;
  std::vector<std::int32_t> squared_cells_;
  std::vector<CellOffset> to_basis_;
};

/// Exact Euclidean distance transform of the part of `window` that lies within the grid.
///
/// Source: Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", 2012, with
/// the arguments of the minima kept as basis points. Cost: linear in the cells of the window.
[[nodiscard]] DistanceTransform distance_transform(const OccupancyGrid& grid,
                                                   const GridWindow& window);
[[nodiscard]] DistanceTransform distance_transform(const OccupancyGrid& grid);
[[nodiscard]] DistanceTransform distance_transform(const StateGrid& grid);

}  // namespace cairn
