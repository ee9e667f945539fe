#include "place/small_scale_star.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn {
namespace {

/// Bearing from the centre of the point where a straight way leaves the circle around it.
double exit_bearing(const Vector2d& center,
                    double radius_m,
                    const Vector2d& p,
                    const Vector2d& direction) {
  const Vector2d from_center = p - center;
  const double along = from_center.dot(direction);
  const double discriminant = along * along - from_center.squaredNorm() + radius_m * radius_m;
  // A way that misses the circle leaves where it is nearest to it.
  const Vector2d exit = from_center + (std::sqrt(std::max(discriminant, 0.0)) - along) * direction;
  return std::atan2(exit.y(), exit.x());
}

double radius_around(const Vector2d& center, const std::vector<Gateway>& gateways) {
  double radius_m = 0.0;
  for (const Gateway& gateway : gateways) {
    radius_m = std::max(radius_m, (gateway.middle - center).norm());
  }
  return radius_m;
}

/// A slot before it has its place in the order.
struct Ray {
  double bearing_rad = 0.0;
  int gateway = -1;  ///< Through which it leaves; -1 for a terminated end.
  std::size_t fragment = 0;
  ControlLaw law = ControlLaw::kMidline;
};

ControlLaw law_through(const Gateway& gateway, double midline_below_m) {
  return gateway.width_m <= midline_below_m ? ControlLaw::kMidline : ControlLaw::kRightWall;
}

}  // namespace

void sort_clockwise(const Vector2d& center, std::vector<Gateway>* gateways) {
  const double radius_m = radius_around(center, *gateways);
  std::stable_sort(gateways->begin(), gateways->end(), [&](const Gateway& a, const Gateway& b) {
    return exit_bearing(center, radius_m, a.middle, a.outward()) >
           exit_bearing(center, radius_m, b.middle, b.outward());
  });
}

Star small_scale_star(const Vector2d& center,
                      const std::vector<Gateway>& gateways,
                      const std::vector<PathFragment>& fragments,
                      double midline_below_m) {
  const double radius_m = radius_around(center, gateways);
  std::vector<Ray> rays;
  const auto add_outward = [&](int number, std::size_t fragment) {
    const Gateway& gateway = gateways[static_cast<std::size_t>(number)];
    rays.push_back({exit_bearing(center, radius_m, gateway.middle, gateway.outward()), number,
                    fragment, law_through(gateway, midline_below_m)});
  };
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const PathFragment& fragment = fragments[f];
    const Gateway& gateway = gateways[static_cast<std::size_t>(fragment.gateway)];
    add_outward(fragment.gateway, f);
    if (fragment.through >= 0) {
      add_outward(fragment.through, f);
    } else {
      rays.push_back({exit_bearing(center, radius_m, gateway.middle, -gateway.outward()), -1, f,
                      fragment.is_dead_end ? ControlLaw::kDeadEnd : ControlLaw::kNone});
    }
  }
  std::stable_sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) {
    return std::tuple(-a.bearing_rad, a.gateway) < std::tuple(-b.bearing_rad, b.gateway);
  });
  Star star;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::size_t partner = 0;
    for (std::size_t j = 0; j < rays.size(); ++j) {
      partner = j != i && rays[j].fragment == rays[i].fragment ? j : partner;
    }
    star.slots.push_back({rays[i].gateway, partner, rays[i].law});
  }
  return star;
}

}  // namespace cairn
