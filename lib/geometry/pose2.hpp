#pragma once

#include <cmath>

#include <Eigen/Core>

#include "geometry/angle.hpp"

namespace cairn {

using Vector2d = Eigen::Vector2d;
using Matrix3d = Eigen::Matrix3d;

/// A rigid transform of the plane, SE(2): where one frame lies within another.
///
/// A variable of this type is called `T_a_b`: the pose of frame b in frame a. It takes coordinates
/// in b to coordinates in a, so inner names cancel:
///
///     Vector2d p_place = T_place_robot * p_robot;
///     Pose2 T_global_robot = T_global_place * T_place_robot;
///
/// In Modayil, Beeson and Kuipers (IROS 2004) T_a_b is written [b]_a, the product is the
/// compounding operator and inverse() its inverse (Sec. IV-C, footnote 2).
class Pose2 {
 public:
  Pose2() = default;
  /// @param theta_rad any finite angle; kept in (-pi, pi]
  Pose2(double x_m, double y_m, double theta_rad)
      : x_m_(x_m), y_m_(y_m), theta_rad_(wrap_angle(theta_rad)) {}
  Pose2(const Vector2d& translation_m, double theta_rad)
      : Pose2(translation_m.x(), translation_m.y(), theta_rad) {}

  [[nodiscard]] double x() const { return x_m_; }
  [[nodiscard]] double y() const { return y_m_; }
  [[nodiscard]] double theta() const { return theta_rad_; }
  [[nodiscard]] Vector2d translation() const { return {x_m_, y_m_}; }

  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(theta_rad_);
    const double s = std::sin(theta_rad_);
    return {-c * x_m_ - s * y_m_, s * x_m_ - c * y_m_, -theta_rad_};
  }

  friend Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
    const Vector2d p = T_a_b * T_b_c.translation();
    return {p.x(), p.y(), T_a_b.theta_rad_ + T_b_c.theta_rad_};
  }

  friend Vector2d operator*(const Pose2& T_a_b, const Vector2d& p_b) {
    const double c = std::cos(T_a_b.theta_rad_);
    const double s = std::sin(T_a_b.theta_rad_);
    return {T_a_b.x_m_ + c * p_b.x() - s * p_b.y(), T_a_b.y_m_ + s * p_b.x() + c * p_b.y()};
  }

  friend bool operator==(const Pose2&, const Pose2&) = default;

 private:
  double x_m_ = 0.0;
  double y_m_ = 0.0;
  double theta_rad_ = 0.0;
};

}  // namespace cairn
