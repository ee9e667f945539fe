#pragma once

#include <array>

#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"
#include "lpm/matchable_map.hpp"

namespace cairn {

/// How well one map lies on another, at the best pose within the search window.
struct MapMatch {
  GaussianPose T_reference_other;
  /// Share of the wall cells of both that lie on or beside a wall of the other, of those that lie
  /// where the other is known. [0, 1]; 0 without common ground.
  double occupied_agreement = 0.0;
  /// Share of the wall cells of both that lie deep in free space of the other, of those that lie
  /// where the other is known.
  double free_conflict = 0.0;
  double overlap_share =
      0.0;  ///< Share of the other's known cells that are known in the reference.
  double common_walls_m = 0.0;  ///< Length of the walls that lie where the other map is known.
  double shift_m = 0.0;         ///< From the guess to the pose found, of the middle of the walls.
  double shift_rad = 0.0;       ///< The same, >= 0.
  /// Natural log of how much better "the same place" explains the overlay than "another place of
  /// the same building, whose star is alike", in [-7, 7]. Calibrated on simulated buildings:
  /// 0 where there is too little common ground for an opinion.
  double log_likelihood_ratio = 0.0;
};

/// What the log-likelihood ratio is linear in: 1; how many walls of either map lie beside those of
/// the other, neither on them nor deep in free space; how many lie deep in free space; how long the
/// walls are that lie where both maps are known. Logarithms, of shares and metres.
using MatchFeatures = std::array<double, 4>;
[[nodiscard]] MatchFeatures features_of(const MapMatch& match);

/// Lays one map of a place over another: the best pose in a window around a guess, by exact
/// multi-resolution search and least squares, and how well they agree there.
///
/// Source: Modayil et al., IROS 2004, Sec. IV-B (relocalization in the stored map of a place);
/// Kuipers et al., ICRA 2004, Sec. III-D, step 4(b) (comparison of local perceptual maps).
/// @pre validate(options).ok(), both maps have the same cell size, and the reference was made with
/// these options
[[nodiscard]] MapMatch match_maps(const MatchableMap& reference,
                                  const MatchableMap& other,
                                  const Pose2& T_reference_other_guess,
                                  const MapMatchOptions& options = {});

/// The same for maps that are compared once.
[[nodiscard]] MapMatch match_maps(const OccupancyGrid& reference,
                                  const OccupancyGrid& other,
                                  const Pose2& T_reference_other_guess,
                                  const MapMatchOptions& options = {});

}  // namespace cairn
