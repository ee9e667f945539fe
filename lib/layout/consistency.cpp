#include "layout/consistency.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "layout/elimination_order.hpp"
#include "layout/normal_equations.hpp"

namespace cairn {
namespace {

/// Shares of a travel's information below this are rounding.
constexpr double kNothing = 1e-6;

Agreement agreement_of(const Eigen::Vector3d& residual, const Matrix3d& predicted_by_all) {
  // What is left of a unit of own information when others and it itself have had their say.
  const Matrix3d left =
      Matrix3d::Identity() - 0.5 * (predicted_by_all + predicted_by_all.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> parts(left);
  Agreement agreement;
  agreement.checked_share = std::clamp(parts.eigenvalues().x(), 0.0, 1.0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double share = parts.eigenvalues()(i);
    if (share > kNothing) {
      const double along = parts.eigenvectors().col(i).dot(residual);
      agreement.chi2 += along * along / share;
    }
  }
  agreement.sigmas = normal_deviate_of_chi2(agreement.chi2);
  return agreement;
}

}  // namespace

double normal_deviate_of_chi2(double chi2) {
  constexpr double kVariance = 2.0 / 27.0;  // 2 / (9 degrees of freedom)
  const double deviate = (std::cbrt(chi2 / 3.0) - (1.0 - kVariance)) / std::sqrt(kVariance);
  return std::max(0.0, deviate);
}

Result<std::vector<Agreement>> agreements_of(const PlaceLayout& layout,
                                             const std::vector<TravelConstraint>& travels) {
  std::vector<Agreement> agreements(travels.size());
  const auto place_count = static_cast<int>(layout.T_global_place.size());
  if (place_count < 2) {
    return agreements;
  }
  const auto at = [](int place) { return static_cast<std::size_t>(place); };
  const std::vector<int> number = elimination_order(place_count, travels);
  PlaceVector places(layout.T_global_place.size());
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Pose2& pose = layout.T_global_place[place];
    places[at(number[place])] = {pose.x(), pose.y(), pose.theta()};
  }
  std::vector<TravelResidual> residuals;
  for (TravelConstraint travel : travels) {
    travel.from = number[at(travel.from)];
    travel.to = number[at(travel.to)];
    residuals.push_back(residual_of(travel));
  }
  NormalEquations equations(place_count, residuals);
  if (!equations.expand_about(places, 0.0)) {
    return Error{ErrorCode::kNotConverged, "layout: the curvature is singular"};
  }
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i].from != residuals[i].to) {
      const TravelResidual& travel = residuals[i];
      agreements[i] = agreement_of(travel.at(places[at(travel.from)], places[at(travel.to)]),
                                   equations.covariance_of_prediction(travel, places));
    }
  }
  return agreements;
}

}  // namespace cairn
