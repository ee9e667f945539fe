#pragma once

#include <array>
#include <cstddef>

namespace cairn {

/// How far the heading of the local map has drifted, from how it lies to the walls of the building
/// along the way; and whether it drifts at all.
///
/// Walls are not quite parallel, and clutter is taken for walls: what a place says about the
/// heading is off by about as much everywhere, alike for all scans of that place. Drift grows with
/// travel. So the offsets of stretches that lie far apart are compared with those of stretches
/// close by (the variogram of geostatistics): what they differ more by is drift, and its rate. A
/// scalar Kalman filter over stretches, with that rate and with the spread of close ones as noise,
/// tells the drift. Where far ones differ no more than close ones, the rate is 0 and nothing is
/// corrected.
///
/// Memory is constant, nothing is allocated.
class HeadingDrift {
 public:
  /// @param travel_m how far the robot has come, never decreasing
  /// @param off_rad by how much the heading believed is turned too far, by the walls seen here
  /// @pre finite
  void absorb(double travel_m, double off_rad);

  /// To be added to the heading believed: 0 at first, and for as long as no drift shows.
  [[nodiscard]] double correction_rad() const { return correction_rad_; }
  /// Variance of the drift that a metre adds, as far as it shows.
  [[nodiscard]] double drift_rad2_per_m() const;

 private:
  static constexpr std::size_t kFarStretches = 60;

  /// Half the mean square of differences.
  struct Differences {
    double sum_rad2 = 0.0;
    double count = 0.0;
    void take(double a_rad, double b_rad);
    void fade();
    [[nodiscard]] double variance() const { return count > 0.0 ? sum_rad2 / count : 0.0; }
  };
  /// Mean offset over one stretch.
  struct Stretch {
    double sum_rad = 0.0;
    int count = 0;
    [[nodiscard]] double mean_rad() const { return sum_rad / count; }
  };

  void end_stretch();
  void filter(double off_rad);

  std::array<Stretch, kFarStretches + 1> stretches_{};  // a ring; at_ is the one under way
  std::size_t at_ = 0;
  double begin_m_ = 0.0;  // of the stretch under way
  bool has_begun_ = false;
  Differences close_;
  Differences far_;
  bool has_offset_ = false;
  double off_rad_ = 0.0;  // as filtered
  double variance_rad2_ = 0.0;
  double correction_rad_ = 0.0;
};

}  // namespace cairn
