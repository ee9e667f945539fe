#pragma once

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"

namespace cairn {

/// How two occupancy grids are laid over each other.
struct MapMatchOptions {
  double search_range_m = 1.5;    ///< Half the window around the guess. [0, 20]
  double search_turn_rad = 0.35;  ///< Half the window around the guess. [0, 3.2]
  double hit_sigma_m =
      0.07;  ///< Spread of a wall of one map around the same wall of the other. > 0
  double min_overlap_share = 0.2;  ///< Less common ground is no evidence. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const MapMatchOptions& options);

/// How well one map lies on another, at the best pose within the search window.
struct MapMatch {
  GaussianPose T_reference_other;
  /// Share of the other's wall cells that lie on or beside a wall of the reference, of those that
  /// lie where the reference is known. [0, 1]; 0 without common ground.
  double occupied_agreement = 0.0;
  /// Share of the cells known in both that contradict: free in one, deep within a wall in the
  /// other.
  double free_conflict = 0.0;
  double overlap_share =
      0.0;  ///< Share of the other's known cells that are known in the reference.
  /// Natural log of how much better "the same place" explains the overlay than "different places",
  /// in [-20, 20]. 0 where there is too little common ground for an opinion.
  double log_likelihood_ratio = 0.0;
};

/// Lays one map of a place over another: the best pose in a window around a guess, by exact
/// multi-resolution search and least squares, and how well they agree there.
///
/// Source: Modayil et al., IROS 2004, Sec. IV-B (relocalization in the stored map of a place);
/// Kuipers et al., ICRA 2004, Sec. III-D, step 4(b) (comparison of local perceptual maps).
/// @pre validate(options).ok(), and both grids have the same cell size
[[nodiscard]] MapMatch match_maps(const OccupancyGrid& reference,
                                  const OccupancyGrid& other,
                                  const Pose2& T_reference_other_guess,
                                  const MapMatchOptions& options = {});

}  // namespace cairn
