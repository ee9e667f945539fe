#pragma once

#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/medial_axis.hpp"
#include "grid/occupancy_grid.hpp"
#include "place/gateway.hpp"
#include "place/place_options.hpp"

namespace cairn {

/// What is remembered from look to look, in the frame of the map.
struct PlaceMemory {
  std::vector<Vector2d> robot_way;  ///< Where the robot has gone of late, oldest first.
  std::vector<Gateway> gateways;    ///< Of the places of the look before.
};

/// What is looked at to find places: the surroundings of the robot, without specks, and their axis.
struct LocalView {
  OccupancyGrid grid;  ///< In the frame of the map; cells of at most `cell_m`.
  DistanceTransform distances;
  MedialAxis axis;
  Vector2d p_map_low = Vector2d::Zero();  ///< Corners of the map that was looked at.
  Vector2d p_map_high = Vector2d::Zero();
  Cell robot;
  PlaceMemory memory;
  std::vector<bool> is_wall;  ///< By cell: a wall, or a chink in one: see `is_wall_at`.

  /// Whether what bounds free space in a cell is a wall. Between the returns of a laser a wall has
  /// chinks of unknown cells; those within two cells of a return count as wall.
  [[nodiscard]] bool is_wall_at(Cell c) const {
    return grid.contains(c) && is_wall[grid.geometry().index_of(c)];
  }
};

/// Cuts the window around the robot out of a map, coarsens it to cells of at most `cell_m` whose
/// corners are multiples of their size (so that nothing jumps when the map scrolls), fills thin
/// unknown stripes between beams, and clears isolated specks.
[[nodiscard]] LocalView look_around(const OccupancyGrid& grid,
                                    const Vector2d& p_grid_robot,
                                    const PlaceOptions& options);

}  // namespace cairn
