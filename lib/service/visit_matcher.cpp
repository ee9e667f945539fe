#include "service/visit_matcher.hpp"

#include <limits>

namespace cairn {

const Recognition& VisitMatcher::compare(VisitId known, VisitId visit, int shift) const {
  const auto key = std::make_tuple(known, visit, shift);
  const auto found = compared_.find(key);
  if (found != compared_.end()) {
    return found->second;
  }
  const std::vector<Visit>& visits = experience_.visits();
  return compared_
      .emplace(key, recognize(visits[known.index()].perceived, visits[visit.index()].perceived,
                              shift, options_))
      .first->second;
}

const GaussianPose& VisitMatcher::dead_reckoned(VisitId known, VisitId visit) const {
  const auto key = std::make_pair(known, visit);
  const auto found = dead_reckoned_.find(key);
  if (found != dead_reckoned_.end()) {
    return found->second;
  }
  GaussianPose T_known_visit;
  for (std::size_t i = known.index(); i < visit.index(); ++i) {
    T_known_visit = compounded(T_known_visit, experience_.travels()[i].T_from_to);
  }
  return dead_reckoned_.emplace(key, T_known_visit).first->second;
}

double VisitMatcher::log_likelihood_ratio(VisitId known, VisitId visit, int shift) const {
  const GaussianPose& predicted = dead_reckoned(known, visit);
  const std::vector<Visit>& visits = experience_.visits();
  const Pose2 T_known_visit =
      aligned_by_gateways(visits[known.index()].perceived, visits[visit.index()].perceived, shift);
  // Gateways alone give the pose to about half a metre; that is enough to see what is out of reach.
  const Matrix3d slack = Eigen::Vector3d(0.25, 0.25, 0.04).asDiagonal();
  if (squared_mahalanobis(T_known_visit, predicted.mean, predicted.covariance + slack) >
      kRefutedAt_sigmas * kRefutedAt_sigmas) {
    return -std::numeric_limits<double>::infinity();
  }
  const Recognition& recognition = compare(known, visit, shift);
  const double chi2 =
      squared_mahalanobis(recognition.T_known_visit.mean, predicted.mean,
                          predicted.covariance + recognition.T_known_visit.covariance);
  if (chi2 > kRefutedAt_sigmas * kRefutedAt_sigmas) {
    return -std::numeric_limits<double>::infinity();
  }
  return recognition.log_likelihood_ratio;
}

GaussianPose VisitMatcher::T_place_visit(const TopologicalMap& map, VisitId visit) const {
  const VisitedPlace at = map.at_visit(visit);
  const VisitId first = map.first_visit(at.place);
  if (first == visit) {
    return {};
  }
  return compare(first, visit, at.shift).T_known_visit;
}

std::vector<TravelConstraint> VisitMatcher::constraints(const TopologicalMap& map) const {
  std::vector<TravelConstraint> constraints;
  for (int i = 0; i + 1 < map.visit_count(); ++i) {
    const VisitId from{i};
    const VisitId to{i + 1};
    const Travel& travel = experience_.travels()[from.index()];
    constraints.push_back({map.at_visit(from).place.value, map.at_visit(to).place.value,
                           compounded(compounded(T_place_visit(map, from), travel.T_from_to),
                                      inverted(T_place_visit(map, to)))});
  }
  return constraints;
}

}  // namespace cairn
