#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/pose2.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/square_maxima.hpp"

namespace cairn {

/// A scan turned by several angles side by side: the squares of cells in which each return comes to
/// lie, and each point on the way to one, from wherever in a square block of cells the robot is.
struct TurnedScan {
  struct Square {
    std::int16_t x = 0;  ///< Its low corner, as seen from the block's, in cells.
    std::int16_t y = 0;
    std::int16_t kind = 0;  ///< How wide it is.
  };
  std::vector<Square> squares;
  std::vector<std::int32_t> offsets;  ///< The same in the maxima of the map.
  Cell low;                           ///< Lower left corner of all low corners.
  Cell high;                          ///< Upper right corner of all low corners.
};

/// A scan at all angles of a window, one by one and by groups of up to 2, 4, 8, 16 side by side.
/// Angles are spaced for the farthest return; most are much nearer and hardly move within a group,
/// so that a bound for a group is about as good as one for an angle.
///
/// A group is made when it is asked for: most of those of few angles never are.
class TurnedScans {
 public:
  static constexpr int kLevels = 5;  ///< Blocks of 1 to 16 cells a side.

  TurnedScans() = default;
  /// Angles that move the farthest return by one cell each, as far as they are in the window.
  /// @param half_rad half the width of the window; from pi on: all angles
  TurnedScans(const std::vector<SurfacePoint>& points,
              double cell_m,
              double center_rad,
              double half_rad);

  [[nodiscard]] std::size_t return_count() const { return points_cells_.size() / kPerReturn; }
  [[nodiscard]] std::size_t angle_count() const { return angles_rad_.size(); }
  [[nodiscard]] double angle_rad(std::size_t angle) const { return angles_rad_[angle]; }
  /// How many angles a group of a level has; the last one may have fewer.
  [[nodiscard]] std::size_t group_size(int level) const {
    return std::size_t{1} << std::max(level - coarseness_, 0);
  }
  [[nodiscard]] std::size_t group_count(int level) const { return groups_of(level).size(); }
  /// How many points had to be turned for the groups that were asked for so far.
  [[nodiscard]] std::int64_t points_turned() const { return points_turned_; }

  /// Returns first, in an order that spreads them over the scan, then two points on each way.
  /// @pre level in [0, kLevels), group in [0, group_count(level)), always the same maxima
  const TurnedScan& group(int level, std::size_t group, const SquareMaxima& maxima);

 private:
  static constexpr std::size_t kPerReturn = 3;  // itself and the points on its way
  [[nodiscard]] const std::vector<TurnedScan>& groups_of(int level) const {
    return groups_[static_cast<std::size_t>(level)];
  }
  void make(int level, std::size_t group, const SquareMaxima& maxima, TurnedScan* turned);

  std::vector<Vector2d> points_cells_;  // not turned
  std::vector<double> angles_rad_;
  int coarseness_ = 0;  // an angle moves the farthest return by 2^this cells at most
  std::array<std::vector<TurnedScan>, kLevels> groups_;
  std::int64_t points_turned_ = 0;
};

}  // namespace cairn
