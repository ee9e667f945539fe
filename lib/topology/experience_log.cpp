#include "topology/experience_log.hpp"

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
  if (!match.is_possible()) {
    return kNoGateway;
  }
  const int number =
      match.gateway_of_view[static_cast<std::size_t>(departing_number(visit, action))];
  return number < 0 ? kNoGateway : map.first_gateway(place) + number;
}

std::vector<int> ExperienceLog::gateways_at(VisitId visit, StarId star, int number) const {
  const ReadingMatch& match = matcher(visit).match(star, number);
  if (match.is_possible()) {
    return match.gateway_of_view;
  }
  std::vector<int> only_arrival(static_cast<std::size_t>(gateway_count(view(visit).star)), -1);
  only_arrival[static_cast<std::size_t>(view(visit).arrival_gateway)] = number;
  return only_arrival;
}

std::size_t ExperienceLog::bytes() const {
  return entries_.capacity() * sizeof(Entry) + views_.size() * sizeof(View) +
         matchers_.size() * sizeof(ReadingMatcher);
}

}  // namespace cairn
