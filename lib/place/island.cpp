#include "place/island.hpp"

#include <cmath>

namespace cairn {

double distinctiveness(const std::vector<Vector2d>& wall_normals) {
  if (wall_normals.empty()) {
    return 0.0;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Vector2d& n : wall_normals) {
    xx += n.x() * n.x();
    xy += n.x() * n.y();
    yy += n.y() * n.y();
  }
  const double mean = 0.5 * (xx + yy);
  const double least = mean - std::hypot(0.5 * (xx - yy), xy);
  return mean > 0.0 ? std::max(0.0, least / mean) : 0.0;
}

}  // namespace cairn
