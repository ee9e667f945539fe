#include "lpm/surface_points.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kNeighbour_m = 1.0;  // farther returns are no neighbours on a surface
constexpr double kEdge = 3.0;         // ratio of distances to neighbours across an edge

Vector2d normal_at(const std::vector<SurfacePoint>& points, std::size_t i) {
  const bool has_before = i > 0;
  const bool has_after = i + 1 < points.size();
  const double before_m = has_before ? (points[i].p - points[i - 1].p).norm() : kNeighbour_m;
  const double after_m = has_after ? (points[i + 1].p - points[i].p).norm() : kNeighbour_m;
  // Across an edge the neighbour belongs to another surface.
  const bool takes_before = has_before && before_m < kNeighbour_m && before_m < kEdge * after_m;
  const bool takes_after = has_after && after_m < kNeighbour_m && after_m < kEdge * before_m;
  if (!takes_before && !takes_after) {
    return Vector2d::Zero();
  }
  const Vector2d along = points[takes_after ? i + 1 : i].p - points[takes_before ? i - 1 : i].p;
  return Vector2d(-along.y(), along.x()).normalized();
}

}  // namespace

std::vector<SurfacePoint> surface_points_of(const LaserScan& scan,
                                            double spacing_m,
                                            double max_range_m) {
  std::vector<SurfacePoint> points;
  const double far_m = std::min(max_range_m, scan.max_range_m);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m <= far_m)) {
      continue;
    }
    const double bearing_rad = static_cast<double>(scan.bearings_rad[i]);
    const Vector2d p = scan.T_robot_laser *
                       Vector2d(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
    if (points.empty() || (p - points.back().p).norm() >= spacing_m) {
      points.push_back({p, Vector2d::Zero()});
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].normal = normal_at(points, i);
  }
  return points;
}

std::vector<SurfacePoint> some_of(const std::vector<SurfacePoint>& points, std::size_t most) {
  if (points.size() <= most) {
    return points;
  }
  std::vector<SurfacePoint> some;
  for (std::size_t i = 0; i < most; ++i) {
    some.push_back(points[i * points.size() / most]);
  }
  return some;
}

}  // namespace cairn
