#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// A straight piece of wall, seen in one scan.
struct WallSegment {
  double direction_rad = 0.0;  ///< Robot frame, modulo 180 degrees: in (-pi/2, pi/2].
  double length_m = 0.0;
  double sigma_rad = 0.0;  ///< Of the direction, from the spread of the returns.
};

/// What counts as a wall, and when walls may speak. In the configuration file: the object
/// "lpm.wall_orientation".
struct WallOrientationOptions {
  double least_length_m = 0.5;       ///< Shorter pieces are no walls. > 0
  int least_returns = 6;             ///< Fewer returns are no wall. [3, 1000]
  double flatness_m = 0.04;          ///< No return lies farther off the line. > 0
  double max_range_m = 15.0;         ///< Farther returns are not looked at. > 0
  double canonical_rad = 0.12;       ///< Walls within this of the directions belong to them.
                                     ///< (0, 0.26]; GRID: others differ by > 15 degrees.
  double least_aligned_share = 0.6;  ///< Of all length of walls, to believe in directions. [0, 1]
  double least_scan_share = 0.5;     ///< Of the length of walls in a scan, to measure. [0, 1]
  double least_scan_length_m = 1.5;  ///< Of aligned walls in a scan, to measure. > 0
  double first_length_m = 100.0;     ///< Length of walls to have seen before the first measure. > 0
  double memory_length_m = 3e4;      ///< Length of walls after which what was seen has faded. > 0
  double least_sigma_rad = 0.005;    ///< No measurement is better: walls are not that parallel. > 0
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const WallOrientationOptions& options);

/// The straight pieces of wall in a scan: neighbouring returns that lie on one line.
[[nodiscard]] std::vector<WallSegment> wall_segments(const LaserScan& scan,
                                                     const WallOrientationOptions& options = {});

/// The two directions, at right angles, along which most walls of a building run.
struct BuildingDirection {
  double direction_rad = 0.0;  ///< In the frame of the poses, modulo 90 degrees: (-pi/4, pi/4].
  double aligned_share = 0.0;  ///< Of all length of walls: how much belongs to them. [0, 1]
};

/// What walls say about the robot's heading.
struct HeadingMeasurement {
  double theta_rad = 0.0;  ///< Of T_lpm_robot.
  double sigma_rad = 0.0;
};

/// The robot's heading by the directions of walls: they are parallel or at right angles in most
/// buildings, so that heading need not drift. Where a building is not like that, it says nothing.
///
/// Directions of wall segments modulo 90 degrees gather in a histogram, by length. Where a large
/// enough share of it lies around its mode, the walls of a scan that belong to that mode tell the
/// heading; walls in other directions do neither count nor harm.
///
/// Source: Thrun and Bücken, AAAI 1996, "Localization", 3: wall orientation, after Crowley 1989 and
/// Hinkel and Knieriemen 1988. As they do, the directions are estimated in the beginning and
/// remembered.
class WallOrientation {
 public:
  /// @pre validate(options).ok()
  explicit WallOrientation(const WallOrientationOptions& options = {});

  /// Takes a scan and the pose it is believed to be taken from, corrected by earlier measurements
  /// or not. Measures where enough walls of scan and building agree.
  std::optional<HeadingMeasurement> absorb(const LaserScan& scan, const Pose2& T_lpm_robot);

  /// None as long as too few walls were seen, or where they do not agree.
  [[nodiscard]] std::optional<BuildingDirection> direction() const;

 private:
  static constexpr int kBins = 180;  // half a degree each

  void gather(const std::vector<WallSegment>& segments, double theta_rad);

  WallOrientationOptions options_;
  std::array<double, kBins> length_m_{};  // by direction modulo 90 degrees
  double seen_m_ = 0.0;
};

}  // namespace cairn
