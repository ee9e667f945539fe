#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/pose2.hpp"

namespace cairn {

/// Where within a cell its surface lies, and which way it faces: the mean of the returns that ended
/// there. In six bytes, since there are many cells.
///
/// Source: the surfels of Droeschel and Behnke, ICRA 2018, cut down to the plane.
struct SurfaceCell {
  static constexpr int kMostReturns =
      20;  ///< Later ones count as much: surfaces may move a little.

  std::int8_t x = 0;  ///< From the centre of the cell, in 1/256 of its side.
  std::int8_t y = 0;
  std::uint8_t returns = 0;  ///< Taken in, kMostReturns at most.
  std::uint8_t facing = 0;   ///< Those of them that knew which way they faced.
  std::int16_t angle = 0;    ///< Of the normal, in 1/65536 of a turn.

  /// @param off_center in cells, each coordinate in [-0.5, 0.5]
  /// @param normal towards the laser, of unit length; or zero where not known
  void take(const Vector2d& off_center, const Vector2d& normal) {
    constexpr double kPerCell = 256.0;
    returns = static_cast<std::uint8_t>(std::min<int>(returns + 1, kMostReturns));
    x = moved(x, kPerCell * off_center.x(), returns);
    y = moved(y, kPerCell * off_center.y(), returns);
    if (normal.x() != 0.0 || normal.y() != 0.0) {
      facing = static_cast<std::uint8_t>(std::min<int>(facing + 1, kMostReturns));
      const std::int16_t seen = angle_of(normal);
      // The shorter way around, by the arithmetic of 16 bits.
      const auto turn = static_cast<std::int16_t>(static_cast<std::uint16_t>(seen - angle));
      angle = static_cast<std::int16_t>(
          static_cast<std::uint16_t>(angle + (facing == 1 ? turn : turn / facing)));
    }
  }

  /// In 1/65536 of a turn, to within a hundredth of a degree.
  [[nodiscard]] static std::int16_t angle_of(const Vector2d& way) {
    // Abramowitz and Stegun, "Handbook of Mathematical Functions", 4.4.49.
    const double ax = std::abs(way.x());
    const double ay = std::abs(way.y());
    const double slope = std::min(ax, ay) / std::max(ax, ay);
    const double square = slope * slope;
    const double octant =
        slope *
        (0.9998660 +
         square * (-0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351))));
    const double quadrant = ay > ax ? 0.5 * kPi - octant : octant;
    const double half = way.x() < 0.0 ? kPi - quadrant : quadrant;
    const double angle = way.y() < 0.0 ? -half : half;
    constexpr double kPerRadian = 32768.0 / kPi;
    return static_cast<std::int16_t>(
        static_cast<std::uint16_t>(static_cast<int>(kPerRadian * angle) & 0xffff));
  }

 private:
  static std::int8_t moved(std::int8_t mean, double value, int count) {
    const double next = mean + (value - mean) / count;
    return static_cast<std::int8_t>(std::clamp(std::floor(next + 0.5), -128.0, 127.0));
  }
};

}  // namespace cairn
