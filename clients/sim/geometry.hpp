#pragma once

#include <cmath>
#include <numbers>

namespace cairn::sim {

/// A point of the world frame: x to the right, y up, origin in the lower left corner of the
/// drawing.
struct Point {
  double x_m = 0.0;
  double y_m = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// A position and a heading, counterclockwise from +x.
struct Pose {
  Point at;
  double theta_rad = 0.0;

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// How far a robot drove along its own arc and how much it turned meanwhile.
struct Motion {
  double distance_m = 0.0;
  double turn_rad = 0.0;
};

/// The same angle in [-pi, pi].
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

[[nodiscard]] inline double distance_m(Point a, Point b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

/// Direction from a to b, counterclockwise from +x.
[[nodiscard]] inline double bearing_rad(Point a, Point b) {
  return std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
}

/// The pose after a short motion, by the chord of its arc.
[[nodiscard]] inline Pose moved(const Pose& pose, const Motion& motion) {
  const double chord_rad = pose.theta_rad + 0.5 * motion.turn_rad;
  return {{pose.at.x_m + motion.distance_m * std::cos(chord_rad),
           pose.at.y_m + motion.distance_m * std::sin(chord_rad)},
          wrap_angle(pose.theta_rad + motion.turn_rad)};
}

}  // namespace cairn::sim
