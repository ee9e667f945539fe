#pragma once

#include <vector>

#include "layout/place_layout.hpp"

namespace cairn {

/// A travel as a term of the sum of squares: by how many standard deviations two poses differ from
/// what was travelled. Part of the place layout; not for other layers.
struct TravelResidual {
  int from = 0;
  int to = 0;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< x, y, theta of T_from_to.
  /// W with W^T W = covariance^-1; lower triangular.
  Matrix3d whitening = Matrix3d::Identity();
  double log_det_covariance = 0.0;

  /// The whitened residual for poses (x, y, theta), any turn of the headings; and, where asked for,
  /// its derivatives by both poses.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& global_from,
                                   const Eigen::Vector3d& global_to,
                                   Matrix3d* by_from = nullptr,
                                   Matrix3d* by_to = nullptr) const;
};

/// @pre validate_displacement(travel.T_from_to).ok()
[[nodiscard]] TravelResidual residual_of(const TravelConstraint& travel);

/// Places as (x, y, theta), by place.
using PlaceVector = std::vector<Eigen::Vector3d>;

}  // namespace cairn
