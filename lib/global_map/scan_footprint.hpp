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
/// hit, so that a wall seen at a grazing angle is not erased by the neighbouring beams.
///
/// Beams pass the cells that they cross, and none beside them: between beams a thin thing may stand
/// unseen. Near the laser, where two beams are less than a cell apart, every cell with its centre
/// between them is crossed by one of them; there the space between beams is filled at once instead,
/// up to the nearer end of both and their neighbours. Cells that a beam only clips, with their
/// centres beyond half a cell from it, may be left out there.
///
/// Keeps its buffers between scans; what it finds does not depend on them. Cost: linear in the rows
/// of cells that beams cross where they are not filled, and in the window around the laser, of
/// which 64 cells are one step.
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
  using Word = std::uint64_t;  ///< One bit for a cell.
  struct Beam {
    double free_cells = 0.0;  ///< 0: says nothing.
    double filled_cells = 0.0;
    bool is_hit = false;
  };

  void look_up_directions(const std::vector<float>& bearings_rad);
  void look_up_beams(const LaserScan& scan);
  void mark_beams();
  void mark_line(const Vector2d& from, const Vector2d& to);
  void mark(int row, int column, int other_column);
  void fill_between_beams();
  void cross_rows(const Vector2d& low, const Vector2d& high, int first_row, int end_row);
  [[nodiscard]] Vector2d point_on(std::size_t beam, double range_cells) const;
  [[nodiscard]] bool take_mark(Cell cell);
  void collect(Cell corner);

  double cell_m_;
  double draw_range_m_;
  int reach_cells_;
  int row_words_;  ///< Words of a row of the window around the laser.

  std::vector<float> bearings_rad_;   ///< Of the scan before: most often those of the next one.
  std::vector<Vector2d> directions_;  ///< Of these bearings, in the laser frame.
  /// Up to where beams are within a cell of their neighbours; 0 for the first and the last one.
  std::vector<double> dense_cells_;

  Vector2d laser_cells_ = Vector2d::Zero();  ///< Coordinates are counted in cells of the window.
  Vector2d ahead_ = Vector2d::Zero();        ///< Of the laser, in the global frame.
  std::vector<Beam> beams_;
  std::vector<Word> marks_;    ///< Row by row; all 0 between calls.
  std::vector<Word> outline_;  ///< Cells at which filling begins or ends; all 0 between calls.
  int low_row_ = 0;            ///< Of the marks.
  int high_row_ = -1;
  TouchedCells touched_;
};

}  // namespace cairn
