#pragma once

#include <cstddef>
#include <string>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"

// What the rows of the journal have in common.
namespace cairn::journal {

inline constexpr std::size_t kMaxRowBytes = std::size_t{64} << 20U;

inline Error malformed(const std::string& what) {
  return {ErrorCode::kMalformed, "journal: " + what};
}

inline void put(const Pose2& pose, double (&out)[3]) {  // NOLINT: the generated type has arrays
  out[0] = pose.x();
  out[1] = pose.y();
  out[2] = pose.theta();
}
inline Pose2 pose_of(const double (&in)[3]) {
  return {in[0], in[1], in[2]};
}  // NOLINT

inline void put(const Matrix3d& matrix, double (&out)[9]) {  // NOLINT
  for (int i = 0; i < 9; ++i) {
    out[i] = matrix(i / 3, i % 3);
  }
}
inline Matrix3d matrix_of(const double (&in)[9]) {  // NOLINT
  Matrix3d matrix;
  for (int i = 0; i < 9; ++i) {
    matrix(i / 3, i % 3) = in[i];
  }
  return matrix;
}

inline void put(const Vector2d& point, double* out) {
  out[0] = point.x();
  out[1] = point.y();
}
inline Vector2d point_of(const double* in) {
  return {in[0], in[1]};
}

}  // namespace cairn::journal
