#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/square_maxima.hpp"

namespace cairn {

/// How a whole map is searched for a scan. In the configuration file: the object
/// "lpm.global_search".
struct GlobalSearchOptions {
  double hit_sigma_m = 0.15;  ///< Spread of a return around the wall, rasters included. > 0
  double max_range_m = 15.0;  ///< Farther returns are not looked at. > 0
  int max_returns = 80;       ///< Returns looked at, spread evenly. [3, 10000]
  double free_weight = 1.0;   ///< Of the way to a return being free, against the return. [0, 10]
  double robot_clearance_m = 0.2;  ///< The robot is no farther than this from a free cell. >= 0
  double neighbour_m = 1.0;        ///< Poses closer than this to a better one are the same, > 0
  double neighbour_rad = 0.4;      ///< and this. > 0
  double independent_share = 0.2;  ///< Share of the returns that count as independent. (0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalSearchOptions& options);

/// Where in a whole map a scan fits.
struct GlobalMatch {
  /// Refined between the cells of the raster; the covariance is positive definite, and long along a
  /// corridor.
  GaussianPose T_map_robot;
  Pose2 raster_pose;   ///< In the middle of a cell, at an angle of the raster.
  double score = 0.0;  ///< Of the raster pose: mean of the returns and of the ways to them, [0, 1].
};

/// The poses to search.
struct GlobalWindow {
  Pose2 center;           ///< T_map_robot
  double range_m = 1e9;   ///< Half the side, >= 0; beyond the map: all of it.
  double turn_rad = 4.0;  ///< Half the angle, >= 0; from pi on: all angles.
};

/// What is asked of a search.
struct GlobalQuery {
  int count = 1;           ///< At most so many poses.
  double min_score = 0.0;  ///< Poses below this are not worth finding: the less there is to do.
  GlobalWindow window = {};
};

/// A known map, made ready to be searched for a robot by a scan and with little prior knowledge or
/// none: the stored LPM of a place or a global map. The pose of the highest mean likelihood of the
/// returns, among all cells near free space and all angles. Exact on its raster of one cell by the
/// angle that moves the farthest return by one cell.
///
/// Source: Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016, Sec. V; Modayil et
/// al., IROS 2004, Sec. IV-B (relocalization in the stored map of a place).
/// Memory: 27 bytes per cell, of which 20 also for a rim of 32 cells.
class GlobalSearch {
 public:
  /// Takes a copy of all that it needs of the map.
  /// @pre validate(options).ok()
  explicit GlobalSearch(const OccupancyGrid& map, const GlobalSearchOptions& options = {});
  /// The same, bit by bit: nothing is taken of the map yet.
  GlobalSearch(const GridGeometry& geometry, const GlobalSearchOptions& options);
  /// Takes some more of the map, which is the same every time.
  /// @param cells how many to take, about; those around walls and free cells count too
  void take(const OccupancyGrid& map, std::int64_t cells);
  [[nodiscard]] bool is_taken() const { return next_step_ == step_count(); }

  /// The best poses, best first: each the best of all that are no neighbours of those before it.
  /// None where there are no points, or no free cell in the window. How much the first is better
  /// than the second is how far it is to be trusted. In one go; see GlobalSearchRun.
  /// @param points in the robot frame, in the order of the beams
  [[nodiscard]] std::vector<GlobalMatch> find(const std::vector<SurfacePoint>& points,
                                              const GlobalQuery& query) const;

  [[nodiscard]] const GridGeometry& geometry() const { return walls_.geometry(); }

 private:
  friend class GlobalSearchRun;

  // What is to be taken, row by row; each tells how much work it was.
  std::int64_t take_walls(const OccupancyGrid& map, int y);
  std::int64_t take_free(const OccupancyGrid& map, int y);
  std::int64_t take_likelihood(int y);
  std::int64_t take_fits(int y);
  std::int64_t widen(int kind);
  std::int64_t take_step(const OccupancyGrid& map, int step);
  [[nodiscard]] int step_count() const;
  void allow_around(Cell free_cell);
  /// Whether the robot fits anywhere in a square, as far as that lies on the map.
  [[nodiscard]] bool fits(Cell low, int side_cells) const;
  [[nodiscard]] std::vector<SurfacePoint> chosen(const std::vector<SurfacePoint>& points) const;
  [[nodiscard]] bool is_near(const Pose2& a, const Pose2& b, double neighbourhoods) const;
  [[nodiscard]] GlobalMatch refined(const std::vector<SurfacePoint>& points,
                                    const Pose2& pose,
                                    double score) const;

  GlobalSearchOptions options_;
  DistanceField walls_;
  std::array<std::uint8_t, DistanceField::kFar + 1> likelihood_at_{};  // by squared distance
  SquareMaxima likelihood_;                                            // of a return
  SquareMaxima freeness_;
  std::vector<std::uint8_t> allowed_;  // where the robot fits
  std::vector<std::int32_t> fits_;     // how many such cells are below and left of a corner
  int next_step_ = 0;
};

}  // namespace cairn
