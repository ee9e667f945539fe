#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "lpm/wall_segments.hpp"

namespace cairn {

/// When walls may speak. In the configuration file: the object "lpm.wall_orientation".
struct WallOrientationOptions {
  bool enabled = true;  ///< Walls correct dead reckoning.
  WallSegmentOptions segment;
  double canonical_rad = 0.12;       ///< Walls within this of a direction belong to it. (0, 0.26];
                                     ///< the paper: all others differ by more than 15 degrees.
  double narrow_rad = 0.04;          ///< Walls of a building of two directions lie within this of
                                     ///< them, by far the most of them. (0, canonical_rad]
  double least_aligned_share = 0.6;  ///< Of all length of walls, to believe in directions. (0, 1]
  double least_scan_share = 0.5;     ///< Of the length of walls in a scan, to measure. (0, 1]
  double least_scan_length_m = 2.0;  ///< Of aligned walls in a scan, to measure. > 0
  double first_length_m = 150.0;     ///< Of walls seen before the first measurement. > 0
  double memory_length_m = 2e4;      ///< Of walls, after which what was seen has faded. > 0
  double gather_every_m = 0.2;       ///< Walls are gathered after this travel, >= 0
  double gather_every_rad = 0.3;     ///< or this turn: standing still proves nothing. >= 0
  double jump_rad = 0.03;            ///< Heading cannot be farther off than this, > 0
  double drift_rad_per_m = 0.001;    ///< with so much for every metre, >= 0
  double drift_rad_per_rad = 0.002;  ///< and turn since the last measurement: else the robot has
                                     ///< come to a wing that is turned. >= 0
  double wall_sigma_rad = 0.01;      ///< How parallel walls are built. > 0
  double least_sigma_rad = 0.004;    ///< No measurement is better. > 0
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const WallOrientationOptions& options);

/// The two directions, at right angles, along which most walls of a building run.
struct BuildingDirection {
  double direction_rad = 0.0;  ///< In the frame of the poses, modulo 90 degrees: (-pi/4, pi/4].
  double aligned_share = 0.0;  ///< Of all length of walls: how much lies close to them. [0, 1]
};

/// What walls say about the robot's heading.
struct HeadingMeasurement {
  double theta_rad = 0.0;  ///< Of T_lpm_robot, (-pi, pi].
  double sigma_rad = 0.0;  ///< > 0
};

/// The robot's heading by the directions of walls, which are parallel or at right angles in most
/// buildings, so that heading need not drift. Where a building is not like that, it says nothing.
///
/// Directions of wall segments modulo 90 degrees gather in a histogram, by length. Where a large
/// enough share of it lies around its mode, the walls of a scan that belong to that mode tell the
/// heading; walls in other directions neither count nor harm.
///
/// Source: Thrun and Bücken, AAAI 1996, "Localization", 3 (wall orientation), after Crowley 1989
/// and Hinkel and Knieriemen 1988. As they do, directions are estimated in the beginning and
/// remembered: later walls are gathered as they lie by the heading that was measured.
class WallOrientation {
 public:
  /// @pre validate(options).ok()
  explicit WallOrientation(const WallOrientationOptions& options = {});

  /// Takes a scan and the pose it is believed to be taken from, corrected by earlier measurements
  /// or not. Measures where enough walls of scan and building agree. A heading that is wrong by
  /// more than `canonical_rad` finds no walls that agree.
  std::optional<HeadingMeasurement> absorb(const ScanBeams& beams, const Pose2& T_lpm_robot);

  /// None as long as too few walls were seen, or where they do not agree.
  [[nodiscard]] std::optional<BuildingDirection> direction() const { return direction_; }

 private:
  static constexpr int kBins = 180;  // half a degree each

  [[nodiscard]] std::optional<HeadingMeasurement> measured(const std::vector<WallSegment>& segments,
                                                           double theta_rad) const;
  /// The mean of the directions that lie within a reach of one, and their length.
  struct Mean {
    double off_rad = 0.0;
    double sigma_rad = 0.0;
    double length_m = 0.0;
  };
  [[nodiscard]] Mean mean_around(const std::vector<WallSegment>& segments,
                                 double theta_rad,
                                 double off_rad,
                                 double reach_rad) const;
  [[nodiscard]] bool is_plausible(double off_rad) const;
  void move_to(const Pose2& T_lpm_robot);
  [[nodiscard]] bool is_due(const Pose2& T_lpm_robot) const;
  void gather(const std::vector<WallSegment>& segments, double theta_rad);
  [[nodiscard]] double length_around(int bin) const;
  void find_direction();

  WallOrientationOptions options_;
  WallSegmenter segmenter_;
  std::array<double, kBins> length_m_{};  // by direction modulo 90 degrees
  double seen_m_ = 0.0;
  std::optional<Pose2> T_lpm_gathered_;
  std::optional<Pose2> T_lpm_last_;
  std::optional<double> last_off_rad_;  // of the heading believed, at the last measurement
  double possible_drift_rad_ = 0.0;     // since then
  std::optional<BuildingDirection> direction_;
};

}  // namespace cairn
