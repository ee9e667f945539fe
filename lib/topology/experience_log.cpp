#include "topology/experience_log.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace cairn {

void ExperienceLog::add(Action action, const View& view, bool is_carried) {
  CAIRN_CHECK(view.visit.index() == entries_.size());
  entries_.push_back({matcher_of(view), action.turn, is_carried});
}

ReadingMatcher* ExperienceLog::matcher_of(const View& view) {
  const bool is_plain = view.others.empty() && view.log_likelihood == 0.0;
  const auto key =
      std::make_pair(is_plain ? stars_->add(view.star) : StarId{}, view.arrival_gateway);
  if (is_plain) {
    const auto known = plain_.find(key);
    if (known != plain_.end()) {
      return known->second;
    }
  }
  for (int reading = 0; reading < reading_count(view); ++reading) {
    stars_->add(star_of(view, reading));
  }
  views_.push_back(view);
  matchers_.emplace_back(views_.back(), *stars_, costs_);
  if (is_plain) {
    plain_[key] = &matchers_.back();
  }
  return &matchers_.back();
}

namespace {

GatewayIndex departure_at(const WorkingMap& map,
                          PlaceId place,
                          const ReadingMatch& match,
                          int departing) {
  const int number =
      match.is_possible() ? match.gateway_of_view[static_cast<std::size_t>(departing)] : -1;
  return number < 0 ? kNoGateway : map.first_gateway(place) + number;
}

}  // namespace

int ExperienceLog::departing_number(VisitId visit, Action action) const {
  const View& from = view(visit);
  return (from.arrival_gateway + action.turn) % gateway_count(from.star);
}

GatewayIndex ExperienceLog::departure(const WorkingMap& map,
                                      GatewayIndex position,
                                      VisitId visit,
                                      Action action) const {
  const PlaceId place = map.place_of(position);
  const ReadingMatch& match = matcher(visit).match(map.star(place), map.number_of(position));
  return departure_at(map, place, match, departing_number(visit, action));
}

std::vector<ExperienceLog::Departure> ExperienceLog::departures(const WorkingMap& map,
                                                                GatewayIndex position,
                                                                VisitId visit,
                                                                Action action) const {
  const PlaceId place = map.place_of(position);
  const StarId star = map.star(place);
  const int arrival = map.number_of(position);
  const int departing = departing_number(visit, action);
  const ReadingMatch& first = matcher(visit).match(star, arrival);
  std::vector<Departure> found = {{departure_at(map, place, first, departing)}};
  for (int choice = 1; choice < choice_count(view(visit), first); ++choice) {
    const ReadingMatch& match = matcher(visit).match(star, arrival, choice);
    const GatewayIndex by = departure_at(map, place, match, departing);
    if (std::none_of(found.begin(), found.end(), [&](const Departure& d) { return d.by == by; })) {
      found.push_back({by, match.log_likelihood - first.log_likelihood});
    }
  }
  return found;
}

std::vector<int> ExperienceLog::gateways_at(VisitId visit,
                                            StarId star,
                                            int number,
                                            int left_by) const {
  const ReadingMatch& first = matcher(visit).match(star, number);
  if (!first.is_possible()) {
    std::vector<int> only_arrival(static_cast<std::size_t>(gateway_count(view(visit).star)), -1);
    only_arrival[static_cast<std::size_t>(view(visit).arrival_gateway)] = number;
    return only_arrival;
  }
  const VisitId next{visit.value + 1};
  for (int choice = 1;
       left_by >= 0 && choice < choice_count(view(visit), first) && next.value < size(); ++choice) {
    const auto departing = static_cast<std::size_t>(departing_number(visit, action(next)));
    const ReadingMatch& match = matcher(visit).match(star, number, choice);
    if (first.gateway_of_view[departing] != left_by &&
        match.gateway_of_view[departing] == left_by) {
      return match.gateway_of_view;
    }
  }
  return first.gateway_of_view;
}

std::size_t ExperienceLog::bytes() const {
  return entries_.capacity() * sizeof(Entry) + views_.size() * sizeof(View) +
         matchers_.size() * sizeof(ReadingMatcher);
}

}  // namespace cairn
