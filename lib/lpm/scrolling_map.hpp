#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "lpm/cell_ring.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/surface_cell.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// The occupancy grid around the robot: a square window that moves with it by whole cells and
/// forgets what has not been seen for some travel. Memory is constant.
///
/// Forgetting is what keeps a large loop from closing by accident: when the robot comes back to
/// where it was long ago, nothing is left there to be matched with.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-A; Modayil et al., IROS 2004, Sec. IV-A (scrolling
/// map).
class ScrollingMap {
 public:
  static constexpr int kBlockCells = 16;  ///< Side of the blocks that are scrolled and forgotten.

  /// @pre the options are within their ranges
  explicit ScrollingMap(const ScrollingMapOptions& options);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// Distance to the walls of grid().
  [[nodiscard]] const DistanceField& walls() const { return walls_; }
  /// What is known of the surface in a wall cell.
  /// @pre grid().contains(wall)
  [[nodiscard]] const SurfaceCell& surface(Cell wall) const { return surfaces_[wall]; }

  /// Draws a scan and scrolls to where it was taken.
  ///
  /// A return makes its cell more likely occupied, and the cells before it more likely free, once
  /// per scan and cell. A beam without return frees the cells up to the first wall: it may have
  /// been swallowed there.
  /// @param travel_m how far the robot has come, from any origin, never decreasing
  void insert(const ScanBeams& beams, const Pose2& T_lpm_robot, double travel_m);
  /// The same for a scan from a standing robot.
  void insert(const LaserScan& scan, const Pose2& T_lpm_robot, double travel_m);
  void clear();
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  void scroll_to(const Vector2d& p_lpm);
  void move_cells(Cell by);
  void forget(double travel_m);
  void forget_block(int block_x, int block_y);
  void begin_scan(double travel_m);
  void mark_returns(const ScanBeams& beams, const Pose2& T_lpm_robot);
  template <bool has_return>
  void free_beam(const Vector2d& from, const Vector2d& to);
  void raise_returns();
  void renew_walls();
  void see_block(Cell c);

  ScrollingMapOptions options_;
  OccupancyGrid grid_;
  DistanceField walls_;
  CellRing<SurfaceCell> surfaces_;
  std::vector<double> seen_travel_m_;  // per block of cells: where the robot was on seeing it last
  std::vector<std::uint8_t> marks_;    // per cell: the scan that has already changed it
  std::uint8_t scan_mark_ = 0;
  double travel_m_ = 0.0;
  double forgotten_at_travel_m_ = 0.0;
  int blocks_across_ = 0;
  std::vector<Cell> returns_;
  std::vector<Cell> new_walls_;
  std::vector<std::size_t> lost_walls_;
};

}  // namespace cairn
