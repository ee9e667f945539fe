#pragma once

#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/scan_refinement.hpp"

namespace cairn {

/// How a whole map is searched for a scan. In the configuration file: the object
/// "lpm.global_search".
struct GlobalSearchOptions {
  double hit_sigma_m = 0.15;       ///< Spread of a return around the wall, rasters included. > 0
  double max_range_m = 20.0;       ///< Farther returns are not looked at. > 0
  int max_returns = 120;           ///< Returns looked at, spread evenly. [3, 10000]
  double robot_clearance_m = 0.2;  ///< The robot is no farther than this from a free cell. >= 0
  double neighbour_m = 0.6;        ///< Poses closer than this to the best are the same, > 0
  double neighbour_rad = 0.3;      ///< and this. > 0
  double independent_share = 0.2;  ///< Share of the returns that count as independent. (0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalSearchOptions& options);

/// A pose on the raster of the search, one cell by the angle that moves the farthest return by one.
struct RasterPose {
  std::int32_t x = 0;
  std::int32_t y = 0;      ///< The cell the robot is in.
  std::int32_t angle = 0;  ///< [0, angles of the raster)
  double score = 0.0;      ///< Mean likelihood of the returns, [0, 1].
};

/// Where in a whole map a scan fits best.
struct GlobalMatch {
  GaussianPose T_map_robot;  ///< Refined between cells; positive definite.
  double score = 0.0;        ///< Of the raster pose: mean likelihood of the returns, [0, 1].
  /// How much better this score is than that of the best pose which is no neighbour of it. Never
  /// negative; the whole score where there is none.
  double margin = 0.0;
};

/// The box of poses to search. Everything, where the ranges are infinite.
struct GlobalWindow {
  Pose2 center;           ///< T_map_robot
  double range_m = 1e9;   ///< Half the side, >= 0
  double turn_rad = 4.0;  ///< Half the angle, >= 0; from pi on: all angles.
};

/// Finds a robot in a known map, stored LPM or global map, by a scan and with poor prior knowledge
/// or none: the pose of the highest mean likelihood of the returns among all cells and angles.
/// Exact on its raster.
///
/// Branch and bound on max-pyramids: the bound of a block of cells is the sum of the maxima of the
/// likelihood that each return can meet within the block. Blocks without a free cell are left out.
///
/// Source: Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016, Sec. V; SKEL IV-B
/// asks for it ("relocalization in the stored map of a place").
class GlobalSearch {
 public:
  /// Takes a copy of all it needs of the map.
  /// @pre validate(options).ok()
  explicit GlobalSearch(const OccupancyGrid& map, const GlobalSearchOptions& options = {});

  /// The best poses, no two of them neighbours, best first: at most `count`. Each is the best of
  /// those that are no neighbours of the ones before it. None where there are no points, or no free
  /// cell in the window.
  /// @param points in the robot frame
  [[nodiscard]] std::vector<GlobalMatch> find(const std::vector<Vector2d>& points,
                                              int count,
                                              const GlobalWindow& window = {}) const;

  /// The mean likelihood of the points at a pose on the raster: what `find` makes the most of.
  [[nodiscard]] double score(const std::vector<Vector2d>& points, const Pose2& T_map_robot) const;

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

 private:
  GridGeometry geometry_;
};

}  // namespace cairn
