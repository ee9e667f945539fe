#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "grid/grid_search.hpp"
#include "grid/occupancy_grid.hpp"

namespace cairn {

/// Tuning of metric paths. In the configuration file: the object "path".
struct PathOptions {
  GridSearchOptions search;
  double corridor_m = 2.0;          ///< A path along a route stays this near to it. > 0
  double waypoint_spacing_m = 0.5;  ///< > 0
  double start_tolerance_m = 0.5;  ///< A robot this near to traversable space may start there. >= 0
  double goal_tolerance_m = 0.0;   ///< A goal in a wall may be moved so far. >= 0
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const PathOptions& options);

/// Where to go: a point, and optionally the heading there.
struct PathGoal {
  Vector2d point_m = Vector2d::Zero();  ///< Global frame.
  std::optional<double> heading_rad;    ///< Any where it is not given.
};

/// A path for the robot's centre. Each heading points to the next waypoint; the last is the goal's,
/// or goes straight on.
struct MetricPath {
  std::vector<Pose2> T_global_waypoint;  ///< From the start's point to the goal's.
  double length_m = 0.0;
  double least_clearance_m = 0.0;  ///< To the nearest wall, over all waypoints and lines between.
  bool left_corridor = false;      ///< No path along the route: this is the best one in free space.
};

/// Metric paths over one occupancy grid.
///
/// A route over places is refined to a path within a corridor about it; where that is blocked, the
/// search is free. A free search first finds the way over large cells and then the best path near
/// to it, which is faster than over all cells and hardly longer; only where that fails, all cells
/// are searched. The path over cells is shortened by lines that are no more expensive than the
/// cells they replace, so it keeps its distance from walls, and is resampled.
class PathPlanner {
 public:
  /// @pre validate(options).ok()
  /// Cost: linear in the number of cells. Later calls of `find_path` share the buffers.
  PathPlanner(const OccupancyGrid& grid, const PathOptions& options);

  /// @param route_m points along the route, for the corridor: its places and, better, the poses of
  ///     its travels, global frame. Empty: the search is free.
  ///
  /// Errors: kInvalidValue where an end is not finite, off the map, in unknown space, in a wall or
  /// nearer to one than the robot's radius; kNotFound where no path leads there. The message names
  /// the end and its coordinates.
  [[nodiscard]] Result<MetricPath> find_path(const Vector2d& start_m,
                                             const PathGoal& goal,
                                             const std::vector<Vector2d>& route_m = {});

 private:
  [[nodiscard]] Result<Cell> standing_cell(const Vector2d& point_m,
                                           double tolerance_m,
                                           const std::string& name) const;
  [[nodiscard]] Result<GridPath> search_cells(Cell start,
                                              Cell goal,
                                              const std::vector<Vector2d>& route_m,
                                              bool* left_corridor);
  [[nodiscard]] Result<GridPath> guided_path(Cell start, Cell goal);
  [[nodiscard]] std::vector<Vector2d> shortened(const GridPath& path) const;
  [[nodiscard]] std::vector<Vector2d> with_exact_ends(const std::vector<Vector2d>& points_m,
                                                      const Vector2d& start_m,
                                                      const Vector2d& goal_m) const;
  [[nodiscard]] double least_clearance_m(const std::vector<Vector2d>& points_m) const;

  PathOptions options_;
  GridSearch search_;
  GridSearch coarse_search_;
};

}  // namespace cairn
