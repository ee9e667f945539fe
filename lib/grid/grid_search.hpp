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
  static constexpr std::uint32_t kOpenWeight = 16;  ///< Of a cell far from walls.

  /// @pre validate(options).ok()
  /// Cost: linear in the number of cells.
  GridSearch(const OccupancyGrid& grid, const GridSearchOptions& options);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  /// Whether the robot's centre may be in this cell; false outside of the grid.
  [[nodiscard]] bool is_traversable(Cell cell) const;
  /// From the centre of the cell to that of the nearest wall, to a tenth of a cell; 6553.5 cells
  /// stand for more. Unknown cells are no walls. 0 in a wall and outside of the grid.
  [[nodiscard]] double clearance_m(Cell cell) const;
  /// Cost of the straight line between the centres of two cells, in metres; infinity where it
  /// crosses a cell that is not traversable.
  [[nodiscard]] double line_cost_m(Cell from, Cell to) const;

  /// The cheapest way. kInvalidValue where an end is not traversable, kNotFound where no way joins
  /// them.
  [[nodiscard]] Result<GridPath> find_path(Cell from, Cell to);

  /// The cheapest way over cells that are at most `reach_cells` from one of the given cells or from
  /// an end. Cost: that of the cells within reach, whatever the size of the grid.
  [[nodiscard]] Result<GridPath> find_path_near(const std::vector<Cell>& line,
                                                int reach_cells,
                                                Cell from,
                                                Cell to);

  /// A search over cells so many times larger: traversable where at least half of the small ones
  /// are, at their mean cost. Finds roughly the way to go in a fraction of the time, but misses
  /// gaps of one or two small cells.
  /// @pre factor >= 1
  [[nodiscard]] GridSearch coarsened(int factor) const;

  /// The traversable cell nearest to a cell, at most `radius_m` away; kNotFound where there is
  /// none.
  [[nodiscard]] Result<Cell> nearest_traversable(Cell cell, double radius_m) const;

 private:
  /// What a search knows of a cell; stale where it is of an earlier search.
  struct Node {
    std::uint32_t cost = 0;  ///< Of the cheapest way found so far.
    std::uint32_t mark =
        0;  ///< Number of the search, and in the lowest bits the step that led here.
  };
  struct Open {
    std::uint32_t cost = 0;
    std::uint32_t index = 0;
  };

  explicit GridSearch(const GridGeometry& geometry);

  void measure_clearance(const OccupancyGrid& grid);
  void set_weights(const OccupancyGrid& grid, const GridSearchOptions& options);
  [[nodiscard]] Result<GridPath> search(const std::vector<std::uint8_t>& weight,
                                        Cell from,
                                        Cell to);
  void begin(std::uint32_t start, std::uint32_t estimate);
  [[nodiscard]] bool run(const std::vector<std::uint8_t>& weight, std::uint32_t goal);
  void expand(const std::vector<std::uint8_t>& weight, const Open& node, Cell goal);
  void open(std::uint32_t estimate, const Open& node);
  void copy_weights(Cell center, int reach_cells);
  void clear_weights(Cell center, int reach_cells);
  [[nodiscard]] GridPath path_to(std::uint32_t index) const;

  // All of them by cell, with a border of one cell about the grid that is not traversable.
  [[nodiscard]] std::uint32_t index_of(Cell cell) const {
    return (static_cast<std::uint32_t>(cell.y) + 1) * stride_ + static_cast<std::uint32_t>(cell.x) +
           1;
  }
  [[nodiscard]] Cell cell_of(std::uint32_t index) const {
    return {static_cast<int>(index % stride_) - 1, static_cast<int>(index / stride_) - 1};
  }

  GridGeometry geometry_;
  std::uint32_t stride_ = 0;
  std::vector<std::uint16_t> tenths_clearance_;
  /// What a metre costs, in parts of kOpenWeight; 0 is not traversable.
  std::vector<std::uint8_t> weight_;
  std::vector<std::uint8_t> near_weight_;  ///< For `find_path_near`; all 0 between calls.
  std::vector<Node> nodes_;
  std::uint32_t search_number_ = 0;

  // Open nodes in a ring of buckets by their estimate, which never falls along a way and rises by
  // less than the ring is long.
  std::vector<std::vector<Open>> buckets_;
  std::uint32_t bucket_ = 0;  ///< The one with the least estimates.
  std::size_t open_count_ = 0;
};

}  // namespace cairn
