#pragma once

#include <cstdint>
#include <vector>

#include "grid/state_grid.hpp"
#include "place/place_options.hpp"

namespace cairn {

/// The surroundings of the robot as cells that are free, walls, or unknown.
///
/// The window around the robot is cut out of a map and coarsened to cells of at most `cell_m` whose
/// corners are multiples of their size, so that nothing jumps when the map scrolls. A wall makes a
/// coarse cell wall, else a free cell makes it free. Thin unknown stripes between beams are filled,
/// and isolated specks cleared.
class LocalStates {
 public:
  /// Looks at a map. Always the same for the same input; asks for memory only when the window has
  /// got another size.
  void take(const OccupancyGrid& map, const Vector2d& p_map_robot, const PlaceOptions& options);

  [[nodiscard]] const StateGrid& grid() const { return grid_; }
  /// By how many cells the window has moved over the ground since the look before; at most its
  /// side.
  [[nodiscard]] Cell moved() const { return moved_; }
  /// By cell, 1: a wall, or a chink in one. Between the returns of a laser a wall has chinks of
  /// unknown cells; those within two cells of a return count as wall.
  [[nodiscard]] const std::vector<std::uint8_t>& is_wall() const { return is_wall_; }

 private:
  /// Cells of one row that are not free, side by side.
  struct Piece {
    int y = 0;
    int first = 0;
    int last = 0;  ///< The last one itself.
    std::size_t parent = 0;
    /// Of the whole 8-connected piece, where this is its root.
    Cell low;
    Cell high;
  };

  void place_window(const OccupancyGrid& map, const Vector2d& p_map_robot, double side_m);
  void coarsen(const OccupancyGrid& map);
  void merge_row(const OccupancyGrid& map, Cell first);
  void fill_stripes();
  void clear_specks(double speck_m);
  void add_piece(int y, int first, int last, std::size_t* below);
  [[nodiscard]] std::size_t root_of(std::size_t piece);
  void join(std::size_t a, std::size_t b);
  void mark_walls();

  StateGrid grid_;
  Cell moved_;
  int factor_ = 1;  ///< Cells of the map along the side of one of the window.
  std::vector<std::uint8_t> is_wall_;
  std::vector<OccupancyGrid::LogOdds> highest_;  ///< One row of the window, in cells of the map.
  std::vector<OccupancyGrid::LogOdds> lowest_;
  std::vector<std::uint8_t> padded_;  ///< The window with a rim, for looking at neighbours.
  std::vector<std::uint8_t> rows_;
  std::vector<Piece> pieces_;
};

}  // namespace cairn
