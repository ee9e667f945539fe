#include "transport/laser_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angle.hpp"

namespace cairn {
namespace {

/// The angle between the outermost beams that read at least so much.
double view_of(const LaserScan& scan, float least_m) {
  float right_rad = std::numeric_limits<float>::infinity();
  float left_rad = -right_rad;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= least_m) {  // NaN is not
      right_rad = std::min(right_rad, scan.bearings_rad[i]);
      left_rad = std::max(left_rad, scan.bearings_rad[i]);
    }
  }
  return left_rad > right_rad ? static_cast<double>(left_rad - right_rad) : 0.0;
}

LaserShape shape_of(const LaserScan& scan) {
  return {scan.ranges_m.size(), view_of(scan, 0.0F), view_of(scan, LaserShapeWatch::kCover_m)};
}

bool is_alike(const LaserShape& a, const LaserShape& b) {
  const auto fewer = static_cast<double>(std::min(a.beams, b.beams));
  const auto more = static_cast<double>(std::max(a.beams, b.beams));
  return more < LaserShapeWatch::kBeamsFactor * fewer &&
         std::abs(a.view_rad - b.view_rad) < LaserShapeWatch::kViewTolerance_rad &&
         std::abs(a.open_view_rad - b.open_view_rad) < LaserShapeWatch::kOpenViewTolerance_rad;
}

}  // namespace

std::string to_string(const LaserShape& shape) {
  return std::to_string(shape.beams) + " beams over " +
         std::to_string(std::lround(shape.open_view_rad * 180.0 / kPi)) + " degrees";
}

std::optional<std::string> LaserShapeWatch::take(const LaserScan& scan) {
  const LaserShape shape = shape_of(scan);
  if (!usual_) {
    usual_ = shape;
  }
  unlike_ = is_alike(shape, *usual_) ? 0 : unlike_ + 1;
  if (unlike_ < kPersistence) {
    return std::nullopt;
  }
  const std::string change = "the laser now gives " + to_string(shape) + ", it gave " +
                             to_string(*usual_) + "; if nobody changed it, see what covers it";
  usual_ = shape;
  unlike_ = 0;
  return change;
}

}  // namespace cairn
