#pragma once

#include <cmath>

#include <cairn_lcm/gateway_t.hpp>
#include <cairn_lcm/place_t.hpp>

namespace cairn::clients {

/// A pose in the plane as the messages carry it: metres, radians counterclockwise.
struct PlanarPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
};

/// Where a body lies in the outer frame, given T_outer_inner and T_inner_body.
[[nodiscard]] inline PlanarPose compound(const PlanarPose& T_outer_inner,
                                         const PlanarPose& T_inner_body) {
  const double c = std::cos(T_outer_inner.theta_rad);
  const double s = std::sin(T_outer_inner.theta_rad);
  return {T_outer_inner.x_m + c * T_inner_body.x_m - s * T_inner_body.y_m,
          T_outer_inner.y_m + s * T_inner_body.x_m + c * T_inner_body.y_m,
          std::remainder(T_outer_inner.theta_rad + T_inner_body.theta_rad, 2.0 * std::acos(-1.0))};
}

/// T_global_place.
[[nodiscard]] inline PlanarPose pose_of(const cairn_lcm::place_t& place) {
  return {place.x_m, place.y_m, place.theta_rad};
}

/// The middle of a gateway in the global frame, heading outwards.
[[nodiscard]] inline PlanarPose pose_of(const cairn_lcm::place_t& place,
                                        const cairn_lcm::gateway_t& gateway) {
  return compound(pose_of(place), {gateway.x_m, gateway.y_m, gateway.bearing_rad});
}

}  // namespace cairn::clients
