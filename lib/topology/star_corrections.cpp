// Steps that blame earlier observations: the star of a place was misread, and is corrected.

#include <algorithm>
#include <cmath>
#include <limits>

#include "star/star_edits.hpp"
#include "topology/successors.hpp"

namespace cairn {
namespace {

/// Whether the path through this gateway passes a place twice.
bool has_place_twice(const WorkingMap& map, GatewayIndex through) {
  std::vector<PlaceId> passed = {map.place_of(through)};
  for (GatewayIndex exit : {through, map.through(through)}) {
    while (exit != kNoGateway && map.is_linked(exit)) {
      const GatewayIndex entry = map.leads_to(exit);
      if (std::find(passed.begin(), passed.end(), map.place_of(entry)) != passed.end()) {
        return true;
      }
      passed.push_back(map.place_of(entry));
      exit = map.through(entry);
    }
  }
  return false;
}

/// Whether a path comes back to this gateway: paths are chains.
bool is_on_ring(const WorkingMap& map, GatewayIndex gateway) {
  GatewayIndex exit = gateway;
  while (exit != kNoGateway && map.is_linked(exit)) {
    exit = map.through(map.leads_to(exit));
    if (exit == gateway) {
      return true;
    }
  }
  return false;
}

bool repeats_a_place_around(const WorkingMap& map, PlaceId place) {
  const GatewayIndex first = map.first_gateway(place);
  for (GatewayIndex at = first; at < first + map.gateway_count(place); ++at) {
    if (has_place_twice(map, at)) {
      return true;
    }
  }
  return false;
}

}  // namespace

// Earlier visits misread the star: the place is as this visit saw it.
void Successors::consider_amendments(GatewayIndex departure,
                                     GatewayIndex target,
                                     const ReadingMatch& match,
                                     const Arrival& arrival) {
  const PlaceId place = map_.place_of(target);
  // A step corrects one star at most.
  if (!match.is_possible() || place == map_.place_of(departure) ||
      arrival.amendment.kind != MapChange::Kind::kNothing) {
    return;
  }
  const double ratio = recognition(target, match, arrival.visit);
  if (map_.is_pending(departure) &&
      !is_worth_blaming(ratio + match.log_likelihood, place, arrival.visit)) {
    return;
  }
  for (int choice = 0; choice < choice_count(arrival.view->view(), match); ++choice) {
    const ReadingMatch& chosen =
        arrival.view->match(map_.star(place), map_.number_of(target), choice);
    std::optional<Amendment> amendment = amendment_of(place, target, chosen, choice, arrival);
    if (amendment) {
      amendment->log_likelihood += ratio;
      consider_amending(departure, target, *amendment, arrival);
    }
  }
}

void Successors::consider_amending(GatewayIndex departure,
                                   GatewayIndex target,
                                   const Amendment& amendment,
                                   const Arrival& arrival) {
  Alternative amended;
  amended.kind = StepKind::kAmended;
  amended.misreading = amendment.misreading;
  amended.departure = departure;
  amended.target = {map_.place_of(target), amendment.arrival_number};
  amended.amendment = amendment.change;
  amended.position = map_.end_gateway() + amendment.arrival_number;
  amended.change = {MapChange::Kind::kNothing, {}, arrival.visit, departure, amended.position};
  if (map_.is_pending(departure)) {
    amended.change.kind = MapChange::Kind::kLink;
  }
  amended.log_likelihood =
      amendment.log_likelihood - penalty_of_amending(amended, departure, amended.position);
  if (!map_.is_pending(departure) ||
      is_worth_blaming(amended.log_likelihood, map_.place_of(target), arrival.visit)) {
    add(amended, arrival);
  }
}

/// Of what the corrected star and the link that then follows do to the paths.
double Successors::penalty_of_amending(const Alternative& amended,
                                       GatewayIndex departure,
                                       GatewayIndex target) {
  const PlaceId place = map_.place_of(amended.amendment.departure);
  const bool links = map_.is_pending(departure);
  const bool was_repeated = repeats_a_place_around(map_, place);
  map_.apply(amended.amendment);
  double penalty = penalty_around(place);
  penalty = (was_repeated && std::isfinite(penalty) ? 0.0 : penalty) +
            (links ? penalty_of_link(departure, target) : 0.0);
  map_.undo(amended.amendment);
  if (links) {
    departing_path_.depart(departure);
  }
  return penalty;
}

/// The place's star as this visit saw it. Every visit that agreed with the old star is to blame.
std::optional<Successors::Amendment> Successors::amendment_of(PlaceId place,
                                                              GatewayIndex target,
                                                              const ReadingMatch& match,
                                                              int choice,
                                                              const Arrival& arrival) {
  const View& view = arrival.view->view();
  const std::optional<AmendedStar> amended = cairn::amended(
      view, match.reading, stars_->star(map_.star(place)), map_.number_of(target), choice);
  if (!amended) {
    return std::nullopt;
  }
  const int before = map_.gateway_count(place);
  const int after = cairn::gateway_count(amended->star);
  if (after < before && was_used(map_.first_gateway(place) + amended->changed_gateway)) {
    return std::nullopt;
  }
  const double own = log_likelihood_of(view, match.reading);
  const double blame = own - match.log_likelihood;
  Amendment amendment;
  amendment.change = {MapChange::Kind::kOtherStar, stars_->add(amended->star), arrival.visit,
                      map_.first_gateway(place), amended->changed_gateway};
  amendment.arrival_number =
      amended->gateway_of_view[static_cast<std::size_t>(view.arrival_gateway)];
  amendment.log_likelihood = own - support(place) * blame;
  amendment.misreading = match.misreading;
  return amendment;
}

/// Whether the robot went through the gateway, or was where it came in by it: it is no false one.
bool Successors::was_used(GatewayIndex at) const {
  if (!map_.is_pending(at)) {
    return true;
  }
  for (std::int32_t index = map_.latest_record(map_.place_of(at)); index >= 0;
       index = map_.record(index).previous) {
    if (map_.record(index).number == map_.number_of(at)) {
      return true;
    }
  }
  for (GatewayIndex other = 0; map_.one_way_count() > 0 && other < map_.end_gateway(); ++other) {
    if (map_.leads_to(other) == at) {
      return true;
    }
  }
  return false;
}

/// Of paths that pass a place twice since the place's star was corrected.
double Successors::penalty_around(PlaceId place) const {
  const GatewayIndex first = map_.first_gateway(place);
  for (GatewayIndex at = first; at < first + map_.gateway_count(place); ++at) {
    if (is_on_ring(map_, at)) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return repeats_a_place_around(map_, place) ? options_->log_penalty_misread : 0.0;
}

/// Infinite unless on one face, or on different parts of the map.
double Successors::penalty_of_link(GatewayIndex departure, GatewayIndex target) {
  bool is_reached = !options_->planar || map_.component(map_.place_of(departure)) !=
                                             map_.component(map_.place_of(target));
  for (GatewayIndex at = map_.next_in_ring(departure); !is_reached && at != departure;
       at = map_.next_in_ring(at)) {
    is_reached = at == target;
  }
  if (!is_reached) {
    return std::numeric_limits<double>::infinity();
  }
  departing_path_.depart(departure);
  return penalty_of_paths(departure, target);
}

}  // namespace cairn
