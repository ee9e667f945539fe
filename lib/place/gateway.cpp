#include "place/gateway.hpp"

namespace cairn {
namespace {

/// Gateways of two readings are the same one within these.
constexpr double kSameGateway_m = 1.0;
constexpr double kSameGateway_rad = 0.6;

}  // namespace

Gateway transformed(const Pose2& T_to_from, const Gateway& gateway) {
  Gateway result = gateway;
  result.basis_points = {T_to_from * gateway.basis_points[0], T_to_from * gateway.basis_points[1]};
  result.middle = T_to_from * gateway.middle;
  result.outward_bearing_rad = wrap_angle(gateway.outward_bearing_rad + T_to_from.theta());
  return result;
}

double distance_beyond_m(const Gateway& gateway, const Vector2d& p) {
  return gateway.outward().dot(p - gateway.middle);
}

int crossing(const Gateway& gateway, const Vector2d& a, const Vector2d& b, double slack_m) {
  const Vector2d line = gateway.basis_points[1] - gateway.basis_points[0];
  const double length = line.norm();
  if (length <= 0.0) {
    return 0;
  }
  // The left end comes second, so what lies to the right of the line's direction lies outward.
  const Vector2d along = line / length;
  const Vector2d outward(along.y(), -along.x());
  const double from = outward.dot(a - gateway.basis_points[0]);
  const double to = outward.dot(b - gateway.basis_points[0]);
  if ((from < 0.0) == (to < 0.0)) {
    return 0;
  }
  const double share = from / (from - to);
  const double at = along.dot(a + share * (b - a) - gateway.basis_points[0]);
  if (at < -slack_m || at > length + slack_m) {
    return 0;
  }
  return from < 0.0 ? 1 : -1;
}

bool is_same_gateway(const Gateway& a, const Gateway& b) {
  return (a.middle - b.middle).norm() < kSameGateway_m &&
         std::abs(turn_between(a.outward_bearing_rad, b.outward_bearing_rad)) < kSameGateway_rad;
}

}  // namespace cairn
