#pragma once

#include <cstdint>
#include <vector>

#include "lpm/scan_refinement.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// How a robot moves during a sweep, in its own frame.
struct Twist {
  double ahead_m_per_s = 0.0;
  double left_m_per_s = 0.0;
  double turn_rad_per_s = 0.0;
};

/// A scan as lines in the plane: from where to where every beam went, in the frame of the robot at
/// the time of the first beam, as if the robot had stood still there.
///
/// Keeps its memory from scan to scan.
class ScanBeams {
 public:
  /// A beam that hit nothing, as far as it is free; or one that ended at a surface.
  struct Beam {
    Vector2d from;
    Vector2d to;
  };

  /// @param twist moves the beams where the scan says how long its sweep took
  /// @param max_free_range_m a beam without return is free no farther
  void take(const LaserScan& scan, const Twist& twist, double max_free_range_m);

  /// Where beams ended, in the order of the scan, with the side of the surface that was seen: the
  /// normal points towards the laser.
  [[nodiscard]] const std::vector<SurfacePoint>& returns() const { return returns_; }
  /// Where the laser was for each of returns().
  [[nodiscard]] const std::vector<Vector2d>& origins() const { return origins_; }
  /// The number within the scan of each of returns().
  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  /// How long each of returns() is.
  [[nodiscard]] const std::vector<float>& ranges_m() const { return ranges_m_; }
  /// Mean angle between neighbouring beams.
  [[nodiscard]] double spacing_rad() const { return spacing_rad_; }
  [[nodiscard]] const std::vector<Beam>& free_beams() const { return free_beams_; }

 private:
  void turn_to(const LaserScan& scan);
  void find_normals();
  [[nodiscard]] Vector2d normal_at(std::size_t i) const;

  std::vector<SurfacePoint> returns_;
  std::vector<Vector2d> origins_;
  std::vector<std::uint32_t> numbers_;
  std::vector<float> ranges_m_;
  std::vector<Beam> free_beams_;
  double spacing_rad_ = 0.0;
  std::vector<float> bearings_rad_;   // of the scan before, most often the same
  std::vector<Vector2d> directions_;  // laser frame
};

}  // namespace cairn
