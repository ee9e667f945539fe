// What evidence says of an arrival: the visits to a place are asked together.

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "topology/successors.hpp"

namespace cairn {

/// What evidence says of two gateways being the same.
double Successors::asked(SeenGateway known, SeenGateway now) const {
  const double ratio = evidence_->same_place(known, now);
  CAIRN_CHECK(ratio < std::numeric_limits<double>::infinity());  // NaN compares false.
  return evidence_->same_place_bound ? ratio : std::min(ratio, options_->max_log_evidence);
}

double Successors::recognition(GatewayIndex target,
                               const ReadingMatch& match,
                               VisitId visit) const {
  return answers(map_.place_of(target), match.gateway_of_view, visit).all;
}

/// What the last visits to the place say together.
/// @param gateway_of_view for each gateway of the visit the place's gateway that it is, or -1
Successors::Answers Successors::answers(PlaceId place,
                                        const std::vector<int>& gateway_of_view,
                                        VisitId visit) const {
  Answers sum;
  if (!evidence_->same_place) {
    return sum;
  }
  int asked_visits = 0;
  for (std::int32_t index = map_.latest_record(place);
       index >= 0 && asked_visits < options_->max_visits_compared;
       index = map_.record(index).previous) {
    const VisitRecord& record = map_.record(index);
    const std::optional<GatewayPair> pair =
        common_gateway(record, map_.star(place), gateway_of_view, visit);
    if (pair) {
      const double ratio = asked({record.visit, pair->known}, {visit, pair->now});
      sum.all += ratio;
      sum.in_favour += std::max(ratio, 0.0);
      ++asked_visits;
    }
  }
  if (asked_visits == 0 && evidence_->log_prior_same) {
    // No visit saw a gateway that this one saw, so no maps are compared: it is there by chance.
    sum.all = -std::log(std::max(map_.pending_count() - 1, 1));
  }
  if (asked_visits > 1) {
    const double worth =
        independent_answers(asked_visits, options_->evidence_correlation) / asked_visits;
    sum.all *= worth;
    sum.in_favour *= worth;
  }
  return sum;
}

Successors::Recognised Successors::likeliest_place(VisitId visit) const {
  ReadingMatcher& view = experience_->matcher(visit);
  Recognised likeliest;
  int asked_gateways = 0;
  for (PlaceId place{0}; place.value < map_.place_count(); ++place.value) {
    if (evidence_->is_within_reach && !evidence_->is_within_reach(map_.first_visit(place), visit)) {
      continue;
    }
    const double log_prior = evidence_->log_prior_same ? log_prior_of_closing(place, visit) : 0.0;
    for (int number = 0; number < map_.gateway_count(place); ++number) {
      const ReadingMatch& match = view.match(map_.star(place), number);
      // Where nothing is known of the way, only what looks exactly alike is no chance.
      if (evidence_->log_prior_same ? !match.is_possible()
                                    : !view.is_exact(map_.star(place), number)) {
        continue;
      }
      ++asked_gateways;
      const Answers said = answers(place, match.gateway_of_view, visit);
      const double log_given = log_prior + match.log_likelihood;
      if (likeliest.at == kNoGateway || said.all + log_given > likeliest.log_likelihood) {
        likeliest.at = map_.first_gateway(place) + number;
        likeliest.log_likelihood = said.all + log_given;
      }
      likeliest.in_favour = std::max(likeliest.in_favour, said.in_favour + log_given);
    }
  }
  const double log_chance = evidence_->log_prior_same ? 0.0 : std::log(std::max(asked_gateways, 1));
  likeliest.log_likelihood -= log_chance;
  likeliest.in_favour -= log_chance;
  return likeliest;
}

/// A gateway that both visits saw, that of arrival if possible; one tells how the stars lie.
std::optional<Successors::GatewayPair> Successors::common_gateway(
    const VisitRecord& known,
    StarId star,
    const std::vector<int>& gateway_of_view,
    VisitId visit) const {
  const ReadingMatch& there = experience_->matcher(known.visit).match(star, known.number);
  if (!there.is_possible()) {
    return std::nullopt;
  }
  const int gateways = static_cast<int>(gateway_of_view.size());
  const int arrived = experience_->view(visit).arrival_gateway;
  for (int turn = 0; turn < gateways; ++turn) {
    const int now = (arrived + turn) % gateways;
    const int number = gateway_of_view[static_cast<std::size_t>(now)];
    const auto seen = std::find(there.gateway_of_view.begin(), there.gateway_of_view.end(), number);
    if (number >= 0 && seen != there.gateway_of_view.end()) {
      return GatewayPair{static_cast<int>(seen - there.gateway_of_view.begin()), now};
    }
  }
  return std::nullopt;
}

/// How many visits saw the star of the place as it is now; one made it known.
int Successors::support(PlaceId place) const {
  int agreeing = 0;
  for (std::int32_t index = map_.latest_record(place); index >= 0;
       index = map_.record(index).previous) {
    const VisitRecord& record = map_.record(index);
    const ReadingMatch& match =
        experience_->matcher(record.visit).match(map_.star(place), record.number);
    agreeing += match.is_possible() && match.misreading == Misreading::kNone ? 1 : 0;
  }
  return std::max(agreeing, 1);
}

}  // namespace cairn
