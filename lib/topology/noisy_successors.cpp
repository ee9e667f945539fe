// Steps that blame this observation, or leave it unexplained: what a map may do about a view that
// contradicts it. Those that blame earlier ones: star_corrections.cpp.

#include <algorithm>
#include <limits>

#include "topology/successors.hpp"

namespace cairn {

// This visit misread the star: the place is as it was known to be.
void Successors::consider_misreading(GatewayIndex departure,
                                     GatewayIndex target,
                                     const ReadingMatch& match,
                                     const Arrival& arrival) {
  if (!match.is_possible()) {
    return;
  }
  Alternative misread;
  misread.kind = StepKind::kMisread;
  misread.misreading = match.misreading;
  misread.departure = departure;
  misread.position = target;
  misread.change = {MapChange::Kind::kNothing, {}, arrival.visit, departure, target};
  misread.log_likelihood = match.log_likelihood + recognition(target, match, arrival.visit);
  if (map_.is_pending(departure)) {
    misread.log_likelihood -= penalty_of_paths(departure, target);
    if (!is_worth_blaming(misread.log_likelihood, map_.place_of(target), arrival.visit)) {
      return;
    }
    misread.change.kind = MapChange::Kind::kLink;
  }
  add(misread, arrival);
}

/// The robot may always have come to a new place instead.
bool Successors::is_worth_blaming(double log_likelihood, PlaceId place, VisitId visit) const {
  return log_likelihood + log_prior_of_closing(place, visit) >=
         options_->log_prior_new_place - options_->blame_margin;
}

/// A place is twice on a path if one of the stars on it was misread. No path is a ring.
double Successors::penalty_of_paths(GatewayIndex departure, GatewayIndex target) {
  const Refutation refutation = refutation_of_link(departure, target);
  if (refutation == Refutation::kNone) {
    return 0.0;
  }
  const bool is_forgivable =
      refutation == Refutation::kPlaceTwiceOnPath && !are_ends_of_one_path(map_, departure, target);
  return is_forgivable ? options_->log_penalty_misread : std::numeric_limits<double>::infinity();
}

// The robot went straight on through the place where the link leads, and on to the next.
void Successors::consider_unnoticed(GatewayIndex departure, const Arrival& arrival) {
  const GatewayIndex passed = map_.leads_to(departure);
  const GatewayIndex onward = map_.through(passed);
  if (arrival.on_the_way != StepKind::kStart || onward == kNoGateway) {
    return;
  }
  Arrival beyond = arrival;
  beyond.log_before -= options_->log_penalty_unnoticed;
  beyond.on_the_way = StepKind::kUnnoticed;
  if (map_.is_pending(onward)) {
    at_pending_gateway(onward, beyond);
  } else {
    at_known_link(onward, beyond);
  }
}

// There is a place on the link that earlier travels did not notice.
void Successors::consider_inserting(GatewayIndex departure, const Arrival& arrival) {
  const View& view = arrival.view->view();
  if (arrival.on_the_way != StepKind::kStart || !map_.is_linked(departure) ||
      (options_->max_places && map_.place_count() >= *options_->max_places)) {
    return;
  }
  for (int reading = 0; reading < reading_count(view); ++reading) {
    const int number = arrival_gateway_of(view, reading);
    if (is_recalled(view, reading) || !through_partner(star_of(view, reading), number)) {
      continue;
    }
    Alternative inserted;
    inserted.kind = StepKind::kInserted;
    inserted.departure = departure;
    inserted.position = map_.end_gateway() + number;
    inserted.change = {MapChange::Kind::kInsertPlace, arrival.view->star_id(reading), arrival.visit,
                       departure, number};
    inserted.log_likelihood = options_->log_prior_new_place + log_likelihood_of(view, reading) -
                              options_->log_penalty_unnoticed;
    add(inserted, arrival);
  }
}

// A gateway that leads here one way may also be where a travel from here ends: the corridor of an
// earlier contradiction.
void Successors::consider_unexplained(GatewayIndex departure, const Arrival& arrival) {
  const GatewayIndex known_target = map_.leads_to(departure);
  for (PlaceId place{0}; place.value < map_.place_count(); ++place.value) {
    const GatewayIndex first = map_.first_gateway(place);
    for (GatewayIndex at = first; at < first + map_.gateway_count(place); ++at) {
      const ReadingMatch& match = arrival.view->match(map_.star(place), at - first);
      if (at == known_target || map_.leads_to(at) != departure || !match.is_possible()) {
        continue;
      }
      Alternative again;
      again.kind = StepKind::kRejoin;
      again.departure = departure;
      again.position = at;
      again.change = {MapChange::Kind::kNothing, {}, arrival.visit, departure, at};
      again.log_likelihood = match.log_likelihood + recognition(at, match, arrival.visit) -
                             options_->log_penalty_misread;
      add(again, arrival);
    }
  }
}

// Evidence says that the robot is at a place which the map has elsewhere, and the symbols allow
// nothing that evidence speaks for. Where the way is known, the robot has joined another path
// segment at a junction that nobody noticed. Else some earlier step was wrong, and as long as
// nobody knows which, the travel stays unexplained; so it may only where the visit is a surprise or
// the map has breaks that are to be mended.
void Successors::consider_rejoining(GatewayIndex departure, const Arrival& arrival) {
  const bool is_map_sound = rejoining_.count(arrival.visit) == 0 && map_.one_way_count() == 0;
  const bool is_way_known = static_cast<bool>(evidence_->log_prior_same);
  if (!evidence_->same_place || (is_map_sound && !is_way_known) ||
      arrival.on_the_way != StepKind::kStart ||
      arrival.amendment.kind != MapChange::Kind::kNothing || is_recognised()) {
    return;
  }
  const Recognised likeliest = likeliest_place(arrival.visit);
  const double log_likelihood =
      likeliest.log_likelihood -
      (is_way_known ? options_->log_penalty_junction : options_->log_penalty_break);
  const double threshold = is_way_known ? 0.0 : options_->recognition_threshold;
  if (likeliest.at == kNoGateway || likeliest.at == departure ||
      likeliest.log_likelihood <= threshold ||
      log_likelihood < options_->log_prior_new_place - options_->blame_margin) {
    return;
  }
  Alternative again;
  again.kind = StepKind::kRejoin;
  again.departure = departure;
  again.position = likeliest.at;
  again.change = {MapChange::Kind::kNothing, {}, arrival.visit, departure, likeliest.at};
  if (map_.is_pending(departure)) {
    again.change.kind = MapChange::Kind::kOneWay;
  }
  again.log_likelihood = log_likelihood;
  add(again, arrival);
}

// The robot left the known link at a junction that nobody noticed, and came to a new place.
void Successors::consider_branching(GatewayIndex departure, const Arrival& arrival) {
  const View& view = arrival.view->view();
  if (!evidence_->log_prior_same || arrival.on_the_way != StepKind::kStart ||
      !map_.is_linked(departure) ||
      (options_->max_places && map_.place_count() >= *options_->max_places)) {
    return;
  }
  for (int reading = 0; reading < reading_count(view); ++reading) {
    if (is_recalled(view, reading)) {
      continue;
    }
    const int number = arrival_gateway_of(view, reading);
    Alternative branched;
    branched.kind = StepKind::kBranch;
    branched.departure = departure;
    branched.position = map_.end_gateway() + number;
    branched.change = {MapChange::Kind::kStrayPlace, arrival.view->star_id(reading), arrival.visit,
                       departure, number};
    branched.log_likelihood = options_->log_prior_new_place + log_likelihood_of(view, reading) -
                              options_->log_penalty_junction;
    add(branched, arrival);
  }
}

/// Whether evidence speaks for one of the alternatives found.
bool Successors::is_recognised() const {
  return std::any_of(found_->begin(), found_->end(), [](const Alternative& one) {
    return one.refuted_by == Refutation::kNone && one.log_likelihood > 0.0;
  });
}

/// The gateway of a place from which it looks most like the view, the departing one only if there
/// is no other.
GatewayIndex Successors::likeliest_gateway(PlaceId place,
                                           GatewayIndex departure,
                                           VisitId visit) const {
  ReadingMatcher& view = experience_->matcher(visit);
  const GatewayIndex first = map_.first_gateway(place);
  const int gateways = map_.gateway_count(place);
  GatewayIndex best = kNoGateway;
  double most = 0.0;
  for (int turn = 0; turn < gateways; ++turn) {
    const GatewayIndex at = first + (view.view().arrival_gateway + turn) % gateways;
    const double likelihood = view.match(map_.star(place), at - first).log_likelihood;
    if (at != departure && (best == kNoGateway || likelihood > most)) {
      best = at;
      most = likelihood;
    }
  }
  return best == kNoGateway ? first : best;
}

Alternative Successors::unexplained(const Situation& situation) {
  const ReadingMatcher& view = experience_->matcher(situation.visit);
  const VisitId before{situation.visit.value - 1};
  Alternative broken;
  broken.kind = StepKind::kContradiction;
  broken.log_likelihood = options_->log_prior_new_place - options_->log_penalty_break;
  if (!experience_->is_carried(situation.visit)) {
    broken.departure = experience_->departure(map_, situation.position, before,
                                              experience_->action(situation.visit));
  }
  if (situation.order.must_be) {
    broken.position =
        likeliest_gateway(*situation.order.must_be, broken.departure, situation.visit);
    broken.target = map_.ref(broken.position);
    const bool leads_nowhere = broken.departure != kNoGateway &&
                               map_.is_pending(broken.departure) &&
                               broken.departure != broken.position;
    broken.change = {leads_nowhere ? MapChange::Kind::kOneWay : MapChange::Kind::kNothing,
                     {},
                     situation.visit,
                     broken.departure,
                     broken.position};
    return broken;
  }
  const int number = arrival_gateway_of(view.view(), 0);
  broken.position = map_.end_gateway() + number;
  broken.change = {MapChange::Kind::kStrayPlace, view.star_id(0), situation.visit, broken.departure,
                   number};
  if (broken.departure != kNoGateway && map_.is_pending(broken.departure)) {
    // Only the bound on places, or evidence, can have left no way out.
    broken.change.kind = MapChange::Kind::kPlace;
  }
  return broken;
}

}  // namespace cairn
