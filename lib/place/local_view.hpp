#pragma once

#include <cstdint>
#include <vector>

#include "grid/axis_update.hpp"
#include "grid/distance_transform.hpp"
#include "grid/distance_update.hpp"
#include "grid/medial_axis.hpp"
#include "grid/state_grid.hpp"
#include "place/gateway.hpp"
#include "place/local_states.hpp"
#include "place/place_options.hpp"

namespace cairn {

/// What is remembered from look to look, in the frame of the map.
struct PlaceMemory {
  std::vector<Vector2d> robot_way;  ///< Where the robot has gone of late, oldest first.
  std::vector<Gateway> gateways;    ///< Of the places of the look before.
};

/// An edge of the axis from cell to cell.
struct EdgeProfile {
  std::vector<double> step_m;                  ///< From each cell to the next; one less than cells.
  std::vector<std::uint8_t> is_along_wall;     ///< By cell, 1: with a wall on one side at least.
  std::vector<std::uint8_t> is_between_walls;  ///< By cell, 1: with walls on both sides.
};

/// What is looked at to find places: the surroundings of the robot, without specks, and their axis.
/// Good as long as the viewer that made it, and until its next look.
struct LocalView {
  const StateGrid& grid;  ///< In the frame of the map; cells of at most `cell_m`.
  const DistanceTransform& distances;
  const std::vector<std::uint8_t>& is_wall;  ///< See LocalStates::is_wall.
  MedialAxis axis{};
  std::vector<EdgeProfile> profiles{};    ///< Of the edges of the axis.
  Vector2d p_map_low = Vector2d::Zero();  ///< Corners of the map that was looked at.
  Vector2d p_map_high = Vector2d::Zero();
  Cell robot{};
  PlaceMemory memory{};

  /// Whether what bounds free space in a cell is a wall, or a chink in one.
  [[nodiscard]] bool is_wall_at(Cell c) const {
    return grid.contains(c) && is_wall[grid.geometry().index_of(c)] != 0;
  }
};

/// Looks around, again and again. What has not changed since the look before is not worked out
/// again, yet every view is what a first look would give.
class LocalViewer {
 public:
  /// The surroundings of the robot and their axis, with a node wherever it turns by more than
  /// `min_turn_rad`.
  [[nodiscard]] LocalView look_around(const OccupancyGrid& grid,
                                      const Vector2d& p_grid_robot,
                                      const PlaceOptions& options,
                                      double min_turn_rad);

 private:
  LocalStates states_;
  DistanceUpdate distances_;
  AxisUpdate axis_;
};

}  // namespace cairn
