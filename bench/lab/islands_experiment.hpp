#pragma once

#include <cstdint>
#include <vector>

#include "clients/sim/world.hpp"
#include "place/island.hpp"
#include "place/place_options.hpp"

namespace cairn::lab {

/// How poses of a building are tried.
struct IslandsOptions {
  double spacing_m = 1.0;     ///< Of the grid of poses. > 0
  double clearance_m = 0.45;  ///< Of poses from walls, at least. > 0
  int starts = 8;             ///< Perturbed starts from each pose. > 0
  double offset_m = 0.5;      ///< Start off by up to this, in x and in y. >= 0
  double turn_rad = 0.15;     ///< And turned by up to this. >= 0
  std::uint64_t seed = 1;
};

/// A pose: what the walls promise, and how well it was found.
struct TriedPose {
  Vector2d p_world = Vector2d::Zero();
  IslandMeasure island;
  double error_m = 0.0;    ///< Mean over the starts, after matching.
  double error_rad = 0.0;  ///< Likewise of the heading.
};

struct IslandsRun {
  std::vector<TriedPose> poses;
  /// Of distinctiveness and error in position; 0 where there is nothing to rank.
  double rank_correlation = 0.0;
  double us_per_measure = 0.0;  ///< CPU time.
};

/// The experiment of Simhon and Dudek, IROS 1998: at every pose of a grid the robot makes a local
/// map, then is put off by a random offset and finds itself again by a new scan; its error is held
/// against the distinctiveness. Same seed, same poses and errors.
[[nodiscard]] IslandsRun run_islands(const sim::World& world, const IslandsOptions& options);

/// Spearman's rank correlation; ties take their mean rank. 0 for fewer than two pairs, or where
/// one of both does not vary.
/// @pre as many of either
[[nodiscard]] double spearman(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace cairn::lab
