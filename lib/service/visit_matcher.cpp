#include "service/visit_matcher.hpp"

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
    constraints.push_back(
        {map.at_visit(from).place.value, map.at_visit(to).place.value,
         compounded(compounded(T_place_visit(map, from), travel.T_from_to),
                    inverted(T_place_visit(map, to)))});
  }
  return constraints;
}

}  // namespace cairn
