#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sensing/laser_scan.hpp"

namespace cairn {

/// How a laser's scans are laid out.
struct LaserShape {
  std::size_t beams = 0;
  /// From the rightmost to the leftmost beam that states anything: a sensor of which one half has
  /// gone blind sees less than its beams span.
  double view_rad = 0.0;
  /// The same of beams that say something else than that there is a cover before the laser.
  double open_view_rad = 0.0;
};

/// As in "181 beams over 180 degrees".
[[nodiscard]] std::string to_string(const LaserShape& shape);

/// Notices that a laser's scans are laid out otherwise than before: its driver was set to other
/// beams, it was replaced, or something has come to cover a part of its view. Spinning sensors
/// whose scans are never quite alike are nothing to speak of.
class LaserShapeWatch {
 public:
  /// Returns from nearer are a cover on the laser.
  static constexpr float kCover_m = 0.2F;
  /// Scans in a row that are unlike those before, after which it is said.
  static constexpr int kPersistence = 10;
  /// Alike are beams whose numbers differ by less than this factor,
  static constexpr double kBeamsFactor = 1.25;
  /// and views that differ by less than this,
  static constexpr double kViewTolerance_rad = 0.35;
  /// and those beside a cover by less than this: a robot that stands at a wall has one, too.
  static constexpr double kOpenViewTolerance_rad = 1.0;

  /// @param scan the next one of that laser
  /// @return what changed, for people, once for each change
  [[nodiscard]] std::optional<std::string> take(const LaserScan& scan);

 private:
  std::optional<LaserShape> usual_;
  int unlike_ = 0;  // in a row
};

}  // namespace cairn
