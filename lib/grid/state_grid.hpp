#pragma once

#include <utility>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn {

/// What is known of the cells of a grid, without how sure it is.
class StateGrid {
 public:
  StateGrid() = default;
  /// All unknown.
  explicit StateGrid(const GridGeometry& geometry)
      : geometry_(geometry), cells_(geometry.cell_count(), CellState::kUnknown) {}

  /// Makes it another grid; the states of the cells are then whatever is written.
  void reshape(const GridGeometry& geometry) {
    geometry_ = geometry;
    cells_.resize(geometry.cell_count());
  }

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] bool contains(Cell c) const { return geometry_.contains(c); }
  /// Unknown outside of the grid.
  [[nodiscard]] CellState state(Cell c) const {
    return contains(c) ? cells_[geometry_.index_of(c)] : CellState::kUnknown;
  }

  /// Row by row from below.
  [[nodiscard]] const std::vector<CellState>& cells() const { return cells_; }
  [[nodiscard]] std::vector<CellState>& cells() { return cells_; }

 private:
  GridGeometry geometry_;
  std::vector<CellState> cells_;
};

}  // namespace cairn
