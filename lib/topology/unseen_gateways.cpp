// Gateways through which the robot came or left and that the star of the place lacks: the star is
// corrected by them.

#include <algorithm>
#include <cmath>
#include <limits>

#include "star/star_edits.hpp"
#include "topology/successors.hpp"

namespace cairn {
namespace {

/// For each gateway of the view its number at a place that lacks the gateway of arrival; -1: that.
/// @param number of the gateway `beside` at the place
std::vector<int> gateways_but_arrival(const View& view, int reading, int number, int beside) {
  const int gateways = gateway_count(star_of(view, reading));
  std::vector<int> numbers(static_cast<std::size_t>(gateway_count(view.star)), -1);
  for (int step = 0; step < gateways; ++step) {
    const int at = (beside + step) % gateways;
    if (at != arrival_gateway_of(view, reading)) {
      const int first = gateway_of_first(view, reading, at);
      if (first >= 0) {
        numbers[static_cast<std::size_t>(first)] = number;
      }
      number = (number + 1) % (gateways - 1);
    }
  }
  return numbers;
}

}  // namespace

// The robot came to a known place by a gateway that earlier visits missed. Without evidence nothing
// would tell such places apart from new ones.
void Successors::consider_unseen_gateways(GatewayIndex departure, const Arrival& arrival) {
  if (!evidence_->same_place || arrival.amendment.kind != MapChange::Kind::kNothing) {
    return;
  }
  for (int reading = 0; reading < reading_count(arrival.view->view()); ++reading) {
    if (reading == 0 || is_recalled(arrival.view->view(), reading)) {
      consider_unseen_gateways_of(departure, reading, arrival);
    }
  }
}

void Successors::consider_unseen_gateways_of(GatewayIndex departure,
                                             int reading,
                                             const Arrival& arrival) {
  const View& view = arrival.view->view();
  const Star& star = star_of(view, reading);
  if (cairn::gateway_count(star) < 2) {
    return;
  }
  const int arrived = arrival_gateway_of(view, reading);
  const int beside = (arrived + 1) % cairn::gateway_count(star);
  const std::optional<Star> as_known = without_gateway(star, arrived);
  if (!as_known) {
    return;
  }
  const ViewClassId wanted =
      stars_->view_class(stars_->add(*as_known), beside > arrived ? beside - 1 : beside);
  for (PlaceId place{0}; place.value < map_.place_count(); ++place.value) {
    const GatewayIndex first = map_.first_gateway(place);
    for (GatewayIndex at = first; at < first + map_.gateway_count(place); ++at) {
      if (map_.view_class(at) == wanted) {
        consider_unseen_gateway(departure, at, beside, reading, arrival);
      }
    }
  }
}

/// @param known gateway of the place that is `beside` of the view
void Successors::consider_unseen_gateway(
    GatewayIndex departure, GatewayIndex known, int beside, int reading, const Arrival& arrival) {
  const View& view = arrival.view->view();
  const Star& star = star_of(view, reading);
  const int arrived = arrival_gateway_of(view, reading);
  const PlaceId place = map_.place_of(known);
  if (map_.gateway_count(place) + 1 != cairn::gateway_count(star)) {
    return;
  }
  const double ratio =
      answers(place, gateways_but_arrival(view, reading, map_.number_of(known), beside),
              arrival.visit)
          .all;
  if (!is_worth_blaming(ratio - options_->log_penalty_missed_gateway, place, arrival.visit)) {
    return;
  }
  const int gateways = cairn::gateway_count(star);
  const int before = gateways - 1;
  // The place's gateway 0 keeps its number, so the reading is numbered from there.
  const int number = map_.number_of(known);
  int first = beside;
  for (int back = 0; back < number; ++back) {
    first = (first + gateways - 1) % gateways;
    first = first == arrived ? (first + gateways - 1) % gateways : first;
  }
  const int inserted = (arrived - first + gateways) % gateways;
  const MapChange amendment{MapChange::Kind::kOtherStar, stars_->add(rotated_to(star, first)),
                            arrival.visit, map_.first_gateway(place), inserted};
  if (map_.gateway_count(place) != before || inserted == 0 || place == map_.place_of(departure)) {
    return;
  }
  Alternative amended;
  amended.kind = StepKind::kAmended;
  amended.misreading = Misreading::kMissedGateway;
  amended.departure = departure;
  amended.target = {place, inserted};
  amended.amendment = amendment;
  amended.position = map_.end_gateway() + inserted;
  amended.change = {MapChange::Kind::kLink, {}, arrival.visit, departure, amended.position};
  amended.log_likelihood = ratio + log_likelihood_of(view, reading) -
                           support(place) * options_->log_penalty_missed_gateway;
  amended.log_likelihood -= penalty_of_amending(amended, departure, amended.position);
  if (is_worth_blaming(amended.log_likelihood, place, arrival.visit)) {
    add(amended, arrival);
  }
}

// The robot left by a gateway that the place's star lacks: the star must be corrected first.
void Successors::from_unseen_gateway(GatewayIndex position, const Arrival& arrival) {
  if (!is_noisy_) {
    return;
  }
  const VisitId before{arrival.visit.value - 1};
  Arrival amending = arrival;
  amending.view = &experience_->matcher(before);
  amending.visit = before;
  const PlaceId place = map_.place_of(position);
  const StarId star = map_.star(place);
  const int number = map_.number_of(position);
  const auto left_by = static_cast<std::size_t>(
      experience_->departing_number(before, experience_->action(arrival.visit)));
  const ReadingMatch& charged = amending.view->match(star, number);
  for (int choice = 0; choice < choice_count(amending.view->view(), charged); ++choice) {
    const ReadingMatch& match = amending.view->match(star, number, choice);
    const std::optional<Amendment> amendment =
        match.gateway_of_view[left_by] < 0 ? amendment_of(place, position, match, choice, amending)
                                           : std::nullopt;
    if (amendment) {
      depart_after_amending(place, *amendment, charged.log_likelihood, arrival);
    }
  }
}

void Successors::depart_after_amending(PlaceId place,
                                       const Amendment& amendment,
                                       double charged,
                                       const Arrival& arrival) {
  const VisitId before{arrival.visit.value - 1};
  Arrival after = arrival;
  after.amendment = amendment.change;
  // What the visit before was charged for misreading the star is given back.
  after.log_before = amendment.log_likelihood - charged;
  map_.apply(amendment.change);
  const GatewayIndex departure =
      experience_->departure(map_, map_.first_gateway(place) + amendment.arrival_number, before,
                             experience_->action(arrival.visit));
  after.log_before -= penalty_around(place);
  if (departure != kNoGateway && map_.is_pending(departure) && std::isfinite(after.log_before)) {
    at_pending_gateway(departure, after);
  }
  map_.undo(amendment.change);
}

}  // namespace cairn
