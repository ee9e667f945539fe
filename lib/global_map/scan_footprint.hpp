#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// Cells of one row that follow each other, counted from the origin of the global frame.
struct CellSpan {
  int y = 0;
  int begin_x = 0;
  int end_x = 0;  ///< Beyond the last one.
};

/// The cells that a scan says something of, each once.
struct TouchedCells {
  std::vector<CellSpan> passed;  ///< Beams only pass. Row by row, from left to right.
  std::vector<Cell> hits;        ///< Beams end here. In the order of the beams.
};

/// Finds the cells that a scan touches, each once: where one beam ends and others pass, it is a
/// hit, so that a wall seen at a grazing angle is not erased by the neighbouring beams. A beam
/// passes every cell that it crosses, and none beside it: between beams a thin thing may stand
/// unseen. Keeps its buffers between scans; what it finds does not depend on them.
///
/// Cost: linear in the rows of cells that the beams cross and in the cells of a window around the
/// laser, of which 64 are one step.
class ScanFootprint {
 public:
  ScanFootprint(double cell_m, double draw_range_m);

  /// Beams are drawn up to the draw range or the scan's max range, whichever is less; +infinity
  /// passes up to there, but no farther than its neighbours where only a few beams lack a return;
  /// NaN says nothing.
  /// @pre the pose is finite and within 2e9 cells of the origin
  /// @return valid until the next call
  [[nodiscard]] const TouchedCells& of(const LaserScan& scan, const Pose2& T_global_laser);

 private:
  using Word = std::uint64_t;

  void look_up_directions(const std::vector<float>& bearings_rad);
  void mark_beam(const Vector2d& from_cells, const Vector2d& to_cells);
  void mark(int row, int column, int other_column);
  [[nodiscard]] bool take_mark(Cell cell);
  void collect(Cell corner);

  double cell_m_;
  double draw_range_m_;
  int reach_cells_;
  int row_words_;            ///< Words of a row of the window around the laser.
  std::vector<Word> marks_;  ///< One bit for a cell of the window; all 0 between calls.
  int low_row_;              ///< Of the marks; above high_row_ where there are none.
  int high_row_ = -1;
  std::vector<float> bearings_rad_;   ///< Of the scan before: most often those of the next one.
  std::vector<Vector2d> directions_;  ///< Of these bearings, in the laser frame.
  TouchedCells touched_;
};

}  // namespace cairn
