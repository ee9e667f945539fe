#include "topology/successors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"

namespace cairn {

bool PlaceOrder::allows(std::optional<PlaceId> place) const {
  if (must_be && place != must_be) {
    return false;
  }
  return !place || std::find(must_not_be.begin(), must_not_be.end(), *place) == must_not_be.end();
}

void Successors::list(const Situation& situation, Detail detail, std::vector<Alternative>& found) {
  found.clear();
  found_ = &found;
  Arrival arrival{situation.visit, &experience_->matcher(situation.visit), &situation.order,
                  detail};
  if (experience_->is_carried(situation.visit)) {
    woken_up(arrival);
    return;
  }
  const VisitId before{situation.visit.value - 1};
  const auto departures = experience_->departures(map_, situation.position, before,
                                                  experience_->action(situation.visit));
  arrival.is_departure_open = departures.size() > 1;
  for (const ExperienceLog::Departure& departure : departures) {
    arrival.log_before = departure.log_likelihood;
    if (departure.by == kNoGateway) {
      from_unseen_gateway(situation.position, arrival);
    } else if (map_.is_pending(departure.by)) {
      at_pending_gateway(departure.by, arrival);
    } else {
      at_known_link(departure.by, arrival);
    }
  }
}

void Successors::at_known_link(GatewayIndex departure, const Arrival& arrival) {
  const GatewayIndex target = map_.leads_to(departure);
  const ReadingMatch& match =
      arrival.view->match(map_.star(map_.place_of(target)), map_.number_of(target));
  Alternative known;
  known.kind = StepKind::kKnownLink;
  known.departure = departure;
  known.position = target;
  const bool is_exact = match.is_possible() && match.misreading == Misreading::kNone;
  if (is_exact) {
    known.log_likelihood = match.log_likelihood + recognition(target, match, arrival.visit);
    add(known, arrival);
  } else {
    ++links_contradicted_;
    refute(Refutation::kOtherView, known, arrival);
  }
  if (is_noisy_) {
    if (!is_exact) {
      consider_misreading(departure, target, match, arrival);
      consider_amendments(departure, target, match, arrival);
    }
    if (!is_exact || known.log_likelihood < 0.0) {
      consider_unnoticed(departure, arrival);
      consider_inserting(departure, arrival);
      consider_branching(departure, arrival);
      consider_rejoining(departure, arrival);
    }
  }
  if (map_.one_way_count() > 0) {
    consider_unexplained(departure, arrival);
  }
}

void Successors::at_pending_gateway(GatewayIndex departure, const Arrival& arrival) {
  departing_path_.depart(departure);
  for (GatewayIndex target = map_.next_in_ring(departure); target != departure;
       target = map_.next_in_ring(target)) {
    consider_closing(departure, target, 0.0, arrival);
  }
  const bool are_faces_kept = map_.rings() == WorkingMap::Rings::kFaces;
  if (map_.component_count() > 1 || (are_faces_kept && !options_->planar) ||
      arrival.detail == Detail::kAll) {
    list_other_faces(departure, arrival);
  }
  if (is_noisy_) {
    consider_unseen_gateways(departure, arrival);
  }
  consider_new_places(departure, arrival);
  if (is_noisy_) {
    consider_rejoining(departure, arrival);
  }
}

// Pending gateways out of the departing one's ring: of other parts of the map, and of other faces.
void Successors::list_other_faces(GatewayIndex departure, const Arrival& arrival) {
  if (map_.rings() == WorkingMap::Rings::kOne) {
    return;
  }
  std::vector<GatewayIndex> ring = {departure};
  for (GatewayIndex at = map_.next_in_ring(departure); at != departure;
       at = map_.next_in_ring(at)) {
    ring.push_back(at);
  }
  std::sort(ring.begin(), ring.end());
  const int component = map_.component(map_.place_of(departure));
  for (PlaceId place{0}; place.value < map_.place_count(); ++place.value) {
    const GatewayIndex first = map_.first_gateway(place);
    for (GatewayIndex at = first; at < first + map_.gateway_count(place); ++at) {
      if (!map_.is_pending(at) || std::binary_search(ring.begin(), ring.end(), at)) {
        continue;
      }
      if (map_.component(place) != component) {
        consider_closing(departure, at, 0.0, arrival);
      } else if (!options_->planar) {
        consider_closing(departure, at, options_->log_penalty_handle, arrival);
      } else {
        Alternative crossing;
        crossing.kind = StepKind::kClosure;
        crossing.departure = departure;
        crossing.position = at;
        refute(Refutation::kOtherFace, crossing, arrival);
      }
    }
  }
}

void Successors::consider_closing(GatewayIndex departure,
                                  GatewayIndex target,
                                  double penalty,
                                  const Arrival& arrival) {
  const PlaceId place = map_.place_of(target);
  const ReadingMatch& match = arrival.view->match(map_.star(place), map_.number_of(target));
  Alternative closure;
  closure.kind = StepKind::kClosure;
  closure.departure = departure;
  closure.position = target;
  closure.change = {MapChange::Kind::kLink, {}, arrival.visit, departure, target};
  if (!match.is_possible() || match.misreading != Misreading::kNone) {
    refute(Refutation::kOtherView, closure, arrival);
    if (is_noisy_) {
      consider_misreading(departure, target, match, arrival);
      consider_amendments(departure, target, match, arrival);
    }
    return;
  }
  const Refutation refutation = refutation_of_link(departure, target);
  const bool is_forgivable = is_noisy_ && refutation == Refutation::kPlaceTwiceOnPath &&
                             !are_ends_of_one_path(map_, departure, target);
  if (refutation != Refutation::kNone && !is_forgivable) {
    refute(refutation, closure, arrival);
    return;
  }
  closure.log_likelihood =
      match.log_likelihood + recognition(target, match, arrival.visit) - penalty;
  if (is_forgivable) {  // One of the stars on the path was misread.
    closure.kind = StepKind::kMisread;
    closure.misreading = Misreading::kFragments;
    closure.log_likelihood -= options_->log_penalty_misread;
    if (!is_worth_blaming(closure.log_likelihood, place, arrival.visit)) {
      return refute(refutation, closure, arrival);
    }
  }
  add(closure, arrival);
}

/// Some gateway of many matches well by chance: before evidence is asked, each is equally likely,
/// those of the place where evidence tells how likely the robot is to be there, else all pending
/// ones.
double Successors::log_prior_of_closing(PlaceId place, VisitId visit) const {
  if (!options_->noisy_stars || !evidence_->same_place) {
    return 0.0;
  }
  return evidence_->log_prior_same ? evidence_->log_prior_same(map_.first_visit(place), visit) -
                                         std::log(map_.gateway_count(place))
                                   : -std::log(std::max(map_.pending_count() - 1, 1));
}

Refutation Successors::refutation_of_link(GatewayIndex departure, GatewayIndex target) {
  if (departing_path_.meeting(target, false) == PathMeeting::kSharePlace) {
    return Refutation::kPlaceTwiceOnPath;
  }
  if (options_->region_consistent && !regions_.stay_consistent(departure, target)) {
    return Refutation::kRegions;
  }
  return Refutation::kNone;
}

// One for each way to read the star.
void Successors::consider_new_places(GatewayIndex departure, const Arrival& arrival) {
  const View& view = arrival.view->view();
  for (int reading = 0; reading < reading_count(view); ++reading) {
    if (is_recalled(view, reading)) {
      continue;
    }
    Alternative fresh;
    fresh.kind = StepKind::kNewPlace;
    fresh.departure = departure;
    const int number = arrival_gateway_of(view, reading);
    fresh.change = {MapChange::Kind::kPlace, arrival.view->star_id(reading), arrival.visit,
                    departure, number};
    fresh.position = map_.end_gateway() + number;
    fresh.log_likelihood = options_->log_prior_new_place + log_likelihood_of(view, reading);
    if (options_->max_places && map_.place_count() >= *options_->max_places) {
      refute(Refutation::kTooManyPlaces, fresh, arrival);
    } else {
      add(fresh, arrival);
    }
  }
}

// The robot may be anywhere, so the gateway from which turns are counted may be any of each place.
void Successors::woken_up(const Arrival& arrival) {
  for (PlaceId place{0}; place.value < map_.place_count(); ++place.value) {
    for (int number = 0; number < map_.gateway_count(place); ++number) {
      const ReadingMatch& match = arrival.view->match(map_.star(place), number);
      Alternative here;
      here.kind = StepKind::kRelocated;
      here.change = {MapChange::Kind::kNothing, {}, arrival.visit, kNoGateway, kNoGateway};
      here.position = map_.first_gateway(place) + number;
      here.misreading = match.misreading;
      if (match.is_possible() && (is_noisy_ || match.misreading == Misreading::kNone)) {
        here.log_likelihood =
            match.log_likelihood + recognition(here.position, match, arrival.visit);
        add(here, arrival);
      } else {
        refute(Refutation::kOtherView, here, arrival);
      }
    }
  }
  const View& view = arrival.view->view();
  for (int reading = 0; reading < reading_count(view); ++reading) {
    if (is_recalled(view, reading)) {
      continue;
    }
    Alternative elsewhere;
    elsewhere.kind = StepKind::kElsewhere;
    const int number = arrival_gateway_of(view, reading);
    elsewhere.change = {MapChange::Kind::kStrayPlace, arrival.view->star_id(reading), arrival.visit,
                        kNoGateway, number};
    elsewhere.position = map_.end_gateway() + number;
    elsewhere.log_likelihood = options_->log_prior_new_place + log_likelihood_of(view, reading);
    if (options_->max_places && map_.place_count() >= *options_->max_places) {
      refute(Refutation::kTooManyPlaces, elsewhere, arrival);
      continue;
    }
    add(elsewhere, arrival);
  }
}

void Successors::add(Alternative alternative, const Arrival& arrival) {
  const bool is_known = !adds_place(alternative.change);
  if (is_known && !alternative.target.place.is_valid()) {
    alternative.target = map_.ref(alternative.position);
  }
  const auto place = is_known ? std::optional(alternative.target.place) : std::nullopt;
  if (!arrival.order->is_empty() && !arrival.order->allows(place)) {
    refute(Refutation::kOperator, alternative, arrival);
    return;
  }
  alternative.log_likelihood += arrival.log_before;
  if (alternative.change.kind == MapChange::Kind::kLink) {
    alternative.log_likelihood += log_prior_of_closing(alternative.target.place, arrival.visit);
  }
  if (alternative.log_likelihood == -std::numeric_limits<double>::infinity()) {
    refute(Refutation::kEvidence, alternative, arrival);
    return;
  }
  if (arrival.on_the_way != StepKind::kStart) {
    alternative.kind = arrival.on_the_way;
  }
  if (arrival.amendment.kind != MapChange::Kind::kNothing) {
    alternative.amendment = arrival.amendment;
  }
  alternative.is_departure_open = arrival.is_departure_open;
  found_->push_back(alternative);
}

void Successors::refute(Refutation reason, Alternative alternative, const Arrival& arrival) {
  ++refuted_[static_cast<std::size_t>(reason)];
  if (arrival.detail == Detail::kPossible) {
    return;
  }
  alternative.refuted_by = reason;
  if (!adds_place(alternative.change) && !alternative.target.place.is_valid()) {
    alternative.target = map_.ref(alternative.position);
  }
  found_->push_back(alternative);
}

}  // namespace cairn
