#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// A cell that a scan says something of, counted from the origin of the global frame.
struct TouchedCell {
  Cell cell;
  bool is_hit = false;  ///< A beam ends here; otherwise beams only pass.
};

/// Finds the cells that a scan touches, each once: where one beam ends and others pass, it is a
/// hit, so that a wall seen at a grazing angle is not erased by the neighbouring beams. Keeps its
/// buffers between scans.
class ScanFootprint {
 public:
  ScanFootprint(double cell_m, double draw_range_m);

  /// The cells row by row. Beams are drawn up to the draw range or the scan's max
  /// range, whichever is less; +infinity passes up to there, but no farther than its neighbours
  /// where only a few beams lack a return; NaN says nothing.
  /// @return valid until the next call
  [[nodiscard]] const std::vector<TouchedCell>& of(const LaserScan& scan,
                                                   const Pose2& T_global_laser);

 private:
  enum class Mark : std::uint8_t { kNone, kPassed, kHit };

  void trace(const Vector2d& from, const Vector2d& to, bool is_hit);
  void collect(Cell corner);

  double draw_range_m_;
  GridGeometry window_;      ///< Around the laser.
  std::vector<Mark> marks_;  ///< Of the window's cells; all kNone between calls.
  std::vector<Cell> ray_;
  std::vector<std::size_t> hits_;  ///< Where beams end, in marks_.
  int low_row_ = 0;                ///< Of the marks; above high_row_ where there are none.
  int high_row_ = -1;
  std::vector<TouchedCell> touched_;
};

}  // namespace cairn
