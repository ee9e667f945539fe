#pragma once

#include <cstdint>
#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/state_grid.hpp"

namespace cairn {

/// A distance transform that follows a map from one state to the next: only where distances may
/// have changed they are computed anew. The result is that of a full computation.
///
/// Free cells of a row between two that are not see no farther, within the row, than those two; so
/// such a run is left as it is while the nearest walls above and below its cells are the same.
///
/// Source: as `distance_transform`. Cost: a linear pass with very little work per cell, and the
/// envelope of parabolas for the runs that are computed anew.
class DistanceUpdate {
 public:
  /// Rows to where there is no wall. Grows by less than as much again over the rows of a grid.
  static constexpr std::int32_t kNone = 1 << 29;

  /// Takes the next state of the map, or the first one.
  /// @param moved by how many cells the window has moved since, over the same ground; what was in
  ///     cell c is now in cell c - moved. Of no account with the first grid, or one of other size.
  void update(const StateGrid& grid, Cell moved);

  [[nodiscard]] const DistanceTransform& distances() const { return result_; }
  /// Indices within the window of the cells whose clearance or basis point is not what it was in
  /// the same place; some more than once.
  [[nodiscard]] const std::vector<std::uint32_t>& changed() const { return changed_; }

 private:
  friend DistanceTransform distance_transform(const OccupancyGrid& grid, const GridWindow& window);

  [[nodiscard]] static DistanceTransform of_part(const OccupancyGrid& grid,
                                                 const GridWindow& window);
  /// The lower envelope of the parabolas (x - position)^2 + height.
  struct Parabola {
    int position = 0;
    double height = 0.0;
    double start = 0.0;  ///< Where it begins to be the lowest.
  };

  /// Free cells side by side, and what bounds them.
  struct Run {
    std::size_t row = 0;  ///< Index of the first cell of the row.
    std::size_t first = 0;
    std::size_t last = 0;   ///< Behind the last one.
    std::size_t begin = 0;  ///< The same with the cells at the ends that are not free.
    std::size_t end = 0;
  };

  void begin(const GridGeometry& geometry, const GridWindow& window);
  void shift(Cell moved);
  void find_nearest_in_columns();
  void update_rows(Cell moved);
  void update_row(std::size_t y, Cell moved);
  void clear_cells(std::size_t row, std::size_t first, std::size_t last);
  [[nodiscard]] bool is_as_it_was(std::size_t first, std::size_t last) const;
  void update_run(const Run& run);
  void renew_run(const Run& run);
  [[nodiscard]] std::int32_t renew_lost(const Run& run);
  void renew_cell(const Run& run, std::size_t x);
  void spread(const Run& run, int column, std::int32_t farthest);
  void put(std::size_t row, std::size_t x, std::int32_t squared, CellOffset to);

  DistanceTransform result_;
  std::vector<std::uint32_t> changed_;
  std::size_t height_ = 0;
  bool is_first_ = true;  ///< Nothing was computed before: all is new.
  std::vector<std::uint8_t> is_free_;
  std::vector<std::int32_t> to_nearest_;      ///< Rows up to the nearest cell that is not free.
  std::vector<std::int32_t> to_nearest_was_;  ///< The same for the state before.
  std::vector<std::int32_t> above_;           ///< One row.
  std::vector<int> new_columns_;              ///< Of a run: where the nearest wall is another one.
  std::vector<Parabola> envelope_;            ///< As long as a row; the first ones are in use.
};

}  // namespace cairn
