#pragma once

#include <vector>

#include "grid/occupancy_grid.hpp"
#include "place/gateway.hpp"
#include "place/island.hpp"
#include "place/local_view.hpp"
#include "place/opening.hpp"
#include "place/path_fragments.hpp"
#include "place/place_options.hpp"
#include "place/star_readings.hpp"
#include "star/star.hpp"

namespace cairn {

/// A region of free space around a junction, corner, room or dead end of the medial axis, bounded
/// by walls and gateways. Coordinates in the frame that the holder names.
struct PlaceNeighbourhood {
  Vector2d center = Vector2d::Zero();
  std::vector<Gateway> gateways;  ///< Clockwise, numbered as in the star.
  std::vector<PathFragment> fragments;
  Star star;
  std::vector<StarReading> others;    ///< Other stars that it may have.
  std::vector<UnsureGateway> unsure;  ///< Openings that may be gateways.
  /// Whether no cell of unknown state can be reached from the centre without leaving through a
  /// gateway or an unsure one. Unknown stretches narrower than the robot do not count.
  bool is_complete = false;
  double radius_m = 0.0;  ///< From the centre to the farthest gateway or wall of the region.
  double distinctiveness =
      0.0;  ///< Near the centre: see place/island.hpp; [0, 1]. 0 until complete.
  bool contains_robot = false;  ///< Whether the robot was inside when this was read.
  /// Every way out that was looked at, gateway or not, and why. For people: nothing is decided by
  /// it, and the journal of visits does not have it.
  std::vector<ConsideredOpening> considered;
};

/// The gateways of the first reading that are sure.
[[nodiscard]] std::vector<Gateway> sure_gateways(const PlaceNeighbourhood& place);

/// The same neighbourhood in another frame.
[[nodiscard]] PlaceNeighbourhood transformed(const Pose2& T_to_from,
                                             const PlaceNeighbourhood& neighbourhood);

/// All places within the window around the robot, in the frame of the grid, complete or not, in an
/// order that depends on the map alone.
///
/// A place is where at least three ways meet, or two that are not in line, or where the only way
/// ends. A straight corridor is none, however its width varies, nor is an alcove less deep than the
/// coastal distance. Points where ways meet that no constriction separates are one place.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-B, geometric criterion.
[[nodiscard]] std::vector<PlaceNeighbourhood> find_places(const OccupancyGrid& grid,
                                                          const Vector2d& p_grid_robot,
                                                          const PlaceOptions& options,
                                                          PlaceMemory memory = {});

/// What one look at the map shows.
struct PlacesAround {
  std::vector<PlaceNeighbourhood> places;
  IslandMeasure at_robot;  ///< How well the walls in sight tell where the robot is.
};

/// The same, and more, with a viewer that has looked at the map before, as a rule from nearby:
/// faster.
[[nodiscard]] PlacesAround find_places(const OccupancyGrid& grid,
                                       const Vector2d& p_grid_robot,
                                       const PlaceOptions& options,
                                       PlaceMemory memory,
                                       LocalViewer* viewer);

}  // namespace cairn
