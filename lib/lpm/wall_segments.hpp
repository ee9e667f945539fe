#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "lpm/scan_beams.hpp"

namespace cairn {

/// What counts as a straight piece of wall.
struct WallSegmentOptions {
  double least_length_m = 0.5;  ///< Shorter pieces are no walls. > 0
  int least_returns = 6;        ///< Fewer returns are no wall. [3, 1000]
  double flatness_m = 0.03;     ///< No return lies farther off the line. > 0
  double greatest_gap_m = 0.3;  ///< Neighbouring returns farther apart lie on two walls. > 0
  double max_range_m = 12.0;    ///< Farther returns are not looked at. > 0
};

/// A straight piece of wall, seen in one scan.
struct WallSegment {
  double direction_rad = 0.0;  ///< Robot frame, modulo 180 degrees: in (-pi/2, pi/2].
  double length_m = 0.0;
  double sigma_rad = 0.0;  ///< Of the direction, from the spread of the returns. > 0
};

/// Finds the straight pieces of wall in scans: split where a return lies off the line through the
/// ends, then least squares. Keeps its memory from scan to scan.
///
/// Source: the iterative end-point fit of Duda and Hart, 1973, as usual in scans (Borges and Aldon,
/// "Line extraction in 2D range images", 2004).
class WallSegmenter {
 public:
  explicit WallSegmenter(const WallSegmentOptions& options = {}) : options_(options) {}

  /// In the order of the beams; valid until the next call.
  const std::vector<WallSegment>& split(const ScanBeams& beams);

 private:
  /// Returns [first, last] of the scan.
  using Stretch = std::pair<std::size_t, std::size_t>;

  WallSegmentOptions options_;
  std::vector<SurfacePoint> points_;
  std::vector<Stretch> open_;  // the next one last
  std::vector<WallSegment> segments_;
};

}  // namespace cairn
