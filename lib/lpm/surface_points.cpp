#include "lpm/surface_points.hpp"

namespace cairn {

std::vector<SurfacePoint> surface_points_of(const LaserScan& scan,
                                            double spacing_m,
                                            double max_range_m) {
  ScanBeams beams;
  beams.take(scan, {}, max_range_m);
  std::vector<SurfacePoint> points;
  surface_points_of(beams, spacing_m, max_range_m, &points);
  return points;
}

void surface_points_of(const ScanBeams& beams,
                       double spacing_m,
                       double max_range_m,
                       std::vector<SurfacePoint>* points) {
  points->clear();
  const double far2_m2 = max_range_m * max_range_m;
  const double spacing2_m2 = spacing_m * spacing_m;
  Vector2d last = Vector2d::Constant(1e9);
  for (std::size_t i = 0; i < beams.returns().size(); ++i) {
    const SurfacePoint& point = beams.returns()[i];
    if ((point.p - last).squaredNorm() >= spacing2_m2 &&
        (point.p - beams.origins()[i]).squaredNorm() <= far2_m2) {
      points->push_back(point);
      last = point.p;
    }
  }
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
