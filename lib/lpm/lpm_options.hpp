#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/result.hpp"
#include "lpm/motion_model.hpp"
#include "lpm/motion_watch.hpp"
#include "lpm/wall_orientation.hpp"

namespace cairn {

/// The scrolling occupancy grid around the robot.
struct ScrollingMapOptions {
  double cell_m = 0.05;           ///< [0.01, 0.5]
  double window_m = 40.0;         ///< Side of the square window. [4, 200]
  double memory_travel_m = 30.0;  ///< What was not seen for this travel is forgotten. > 0
  double hit_log_odds = 0.9;      ///< Added to the cell a beam ends in. [0.41, 3]
  double miss_log_odds = 0.45;    ///< Taken from a cell a beam passes through. [0.41, 3]
  /// Clamp, so that what has moved away fades: it is no wall any more after
  /// ceil((max_log_odds - 0.4) / miss_log_odds) scans through where it stood, 7 with these
  /// defaults, however often it was seen there. Scans that the map takes up count: one every
  /// `insert_every_m` or `insert_every_rad`, so 1.4 m of travel; while the robot stands nothing
  /// fades. [1, 20]
  double max_log_odds = 3.5;
  double max_free_range_m = 20.0;  ///< A beam without return frees no more than this. > 0
};

/// How motion is foretold from one scan to the next, to start matching from. In the configuration
/// file: the object "lpm.motion".
struct MotionOptions {
  MotionLearningOptions learning;
  bool learns = true;             ///< Odometry is corrected, and believed as far as it has earned.
  double widening = 25.0;         ///< Variances foretold count as so much larger, [1, 100]
  double least_sigma_m = 0.05;    ///< and this is added, > 0
  double least_sigma_rad = 0.02;  ///< and this. > 0
};

/// Scan matching against the scrolling map.
struct ScanMatchOptions {
  double point_spacing_m = 0.02;      ///< Returns closer together than this are thinned. >= 0
  double max_match_range_m = 40.0;    ///< Farther returns are not matched. > 0
  double hit_sigma_m = 0.05;          ///< Spread of a return around the wall. > 0
  double independent_share = 0.2;     ///< Share of returns that count as independent. (0, 1]
  double min_explained_share = 0.45;  ///< Of the returns over known cells; below: refused. [0, 1]
  int min_returns = 12;               ///< Fewer returns: the sensor is blocked. [3, 10000]
  double search_range_m = 0.6;        ///< Half the window of the wide search. [0, 5]
  double search_turn_rad = 0.4;       ///< Half the window of the wide search. [0, 3.2]
};

/// How scans are matched with the scrolling map. In the configuration file: "correlative" or
/// "particles".
enum class MatcherKind : std::uint8_t {
  kCorrelative,  ///< Least squares, and correlative search where that fails.
  kParticles,    ///< The papers' particle filter.
};

/// The name of a kind, as in the configuration file.
[[nodiscard]] std::string_view to_string(MatcherKind kind);
/// None for a name that is no kind's.
[[nodiscard]] std::optional<MatcherKind> matcher_kind_of(std::string_view name);

/// Tuning of the particle filter. In the configuration file: the object "lpm.particles".
struct ParticleOptions {
  int least_count = 200;         ///< [20, 100000]
  int greatest_count = 2'000;    ///< [20, 100000]; below the least count it counts as that.
  double bin_m = 0.05;           ///< Particles closer than this count as alike, > 0
  double bin_rad = 0.03;         ///< and this. > 0
  double kld_error = 0.05;       ///< Of the sampled belief. (0, 1)
  double kld_quantile = 2.33;    ///< Of the normal distribution: 2.33 for 99 %. [0, 5]
  double effective_share = 0.5;  ///< Of particles that a tempering step must leave. (0, 1)
  int max_returns = 120;         ///< Returns weighed per particle. [10, 10000]
  std::int64_t seed = 1;         ///< Same seed, same scans: same poses, bit for bit.
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const ParticleOptions& options);

/// The local metrical layer. In the configuration file: the object "lpm".
struct LpmOptions {
  ScrollingMapOptions map;
  MotionOptions motion;
  MotionWatchOptions motion_watch;
  ScanMatchOptions match;
  MatcherKind matcher = MatcherKind::kCorrelative;
  WallOrientationOptions wall_orientation;
  ParticleOptions particles;      ///< Where `matcher` says so.
  double insert_every_m = 0.2;    ///< The map takes a scan after this travel, [0, 5]
  double insert_every_rad = 0.2;  ///< or after this turn. [0, 3.2]
  double renewal_travel_m = 8.0;  ///< Travel after which the map is another one: per renewal the
                                  ///< error of one match adds to dead reckoning. > 0
  /// So many in a row: the map is drawn anew around the robot, or starts afresh. [1, 1000]
  int refusals_before_restart = 5;
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const LpmOptions& options);

}  // namespace cairn
