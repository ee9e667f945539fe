#pragma once

#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Tuning of ways over a grid. In the configuration file: the object "grid_search".
struct GridSearchOptions {
  double robot_radius_m = 0.2;       ///< Cells with less clearance are not traversable. >= 0
  double comfort_clearance_m = 0.5;  ///< Nearer to walls than this, cells cost more. >= 0
  double wall_cost = 3.0;            ///< Added cost per metre at the robot's radius. [0, 14]
  bool unknown_is_traversable = false;
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GridSearchOptions& options);

/// A way over the cells of a grid: each cell is a neighbour of the one before.
struct GridPath {
  std::vector<Cell> cells;  ///< From start to goal, both included.
  double length_m = 0.0;
  double cost_m = 0.0;  ///< Length weighted by nearness to walls; >= length_m.
};

/// Ways over one occupancy grid that keep clear of walls: A* over eight neighbours.
///
/// The cost of a metre is 1 in the open and grows linearly to 1 + wall_cost at the robot's radius.
/// Costs are whole numbers and ties are broken by the order of cells, so ways are the same on every
/// machine. Clearance and costs are computed once; the buffers of a search are kept for the next.
///
/// Source: Thrun and Bücken, AAAI 1996 (clearance; minimum-cost paths over an occupancy grid), with
/// A* in the place of value iteration, as only one goal is asked for.
class GridSearch {
 public:
  /// @pre validate(options).ok()
  /// Cost: linear in the number of cells.
  GridSearch(const OccupancyGrid& grid, const GridSearchOptions& options);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  /// Whether the robot's centre may be in this cell; false outside of the grid.
  [[nodiscard]] bool is_traversable(Cell cell) const;
  /// From the centre of the cell to that of the nearest wall; at most 25.5 cells are told apart
  /// from farther ones. 0 in a wall and outside of the grid.
  [[nodiscard]] double clearance_m(Cell cell) const;
  /// Cost of the straight line between the centres of two cells, in metres; infinity where it
  /// crosses a cell that is not traversable.
  [[nodiscard]] double line_cost_m(Cell from, Cell to) const;

  /// The cheapest way. kInvalidValue where an end is not traversable, kNotFound where no way joins
  /// them.
  [[nodiscard]] Result<GridPath> find_path(Cell from, Cell to);

  /// The same, over allowed cells only: one entry per cell of the grid, not zero is allowed.
  /// @pre allowed.size() == geometry().cell_count()
  [[nodiscard]] Result<GridPath> find_path_within(const std::vector<std::uint8_t>& allowed,
                                                  Cell from,
                                                  Cell to);

  /// The traversable cell nearest to a cell, at most `radius_m` away; kNotFound where there is
  /// none.
  [[nodiscard]] Result<Cell> nearest_traversable(Cell cell, double radius_m) const;

 private:
  /// What a search knows of a cell; stale where it is of an earlier search.
  struct Node {
    std::uint32_t cost = 0;    ///< Of the cheapest way found so far.
    std::uint32_t search = 0;  ///< Number of the search that wrote this.
    std::uint32_t parent = 0;  ///< Index of the cell before.
  };
  struct Open {
    std::uint32_t estimate = 0;  ///< Cost up to the goal; the heap's key.
    std::uint32_t cost = 0;
    std::uint32_t index = 0;
  };

  void measure_clearance(const OccupancyGrid& grid);
  void set_weights(const OccupancyGrid& grid, const GridSearchOptions& options);
  [[nodiscard]] Result<GridPath> search(Cell from, Cell to, const std::uint8_t* allowed);
  void begin(std::uint32_t start, std::uint32_t estimate);
  void expand(const Open& node, Cell goal, const std::uint8_t* allowed);
  [[nodiscard]] GridPath path_to(std::uint32_t index) const;
  [[nodiscard]] Cell cell_of(std::uint32_t index) const;

  GridGeometry geometry_;
  std::vector<std::uint8_t> tenths_clearance_;  ///< By cell.
  /// By cell: sixteenths of the cost of an open cell; 0 is not traversable.
  std::vector<std::uint8_t> weight_;
  std::vector<Node> nodes_;
  std::vector<Open> open_;
  std::uint32_t search_number_ = 0;
};

}  // namespace cairn
