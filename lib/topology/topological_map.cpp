#include "topology/topological_map.hpp"

#include <utility>

#include "base/check.hpp"

namespace cairn {

TopologicalMap::TopologicalMap(std::shared_ptr<const StarCatalogue> stars, const Arrival& arrival)
    : stars_(std::move(stars)) {
  move_to(append_place(arrival, 0), arrival);
}

TopologicalMap::TopologicalMap(std::shared_ptr<const StarCatalogue> stars,
                               const WorkingMap& map,
                               const std::vector<PlacedVisit>& visits)
    : stars_(std::move(stars)),
      path_count_(map.path_count()),
      pending_count_(map.pending_count()),
      component_count_(map.component_count()),
      unexplained_count_(map.one_way_count()) {
  int linked_ends = 0;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    places_.push_back(
        {map.star(place), exits_.size(), map.component(place), map.first_visit(place)});
    const GatewayIndex first = map.first_gateway(place);
    for (GatewayIndex at = first; at < first + map.gateway_count(place); ++at) {
      exits_.push_back(map.is_pending(at) ? GatewayRef{} : map.ref(map.leads_to(at)));
      linked_ends += map.is_linked(at) ? 1 : 0;
    }
  }
  closure_count_ = linked_ends / 2 - map.place_count() + map.parts_begun();
  for (const PlacedVisit& visit : visits) {
    const VisitId id{visit_count()};
    const int gateways = gateway_count(visit.arrival.place);
    const int shift = visit.arrival.gateway - visit.arrival_of_view % gateways + gateways;
    visits_.push_back({visit.arrival.place, shift % gateways});
    if (!visit.gateways.empty()) {
      misread_[id] = visit.gateways;
    }
    if (visit.is_carried) {
      carried_.insert(id);
    }
  }
  position_ = visits.back().arrival;
}

int TopologicalMap::gateway_at(VisitId visit, int gateway) const {
  const auto misread = misread_.find(visit);
  if (misread != misread_.end()) {
    return misread->second[static_cast<std::size_t>(gateway)];
  }
  const VisitedPlace at = at_visit(visit);
  return (gateway + at.shift) % gateway_count(at.place);
}

std::optional<GatewayRef> TopologicalMap::through(GatewayRef at) const {
  const int gateway = stars_->through(star_of(at.place), at.gateway);
  return gateway < 0 ? std::nullopt : std::optional(GatewayRef{at.place, gateway});
}

std::optional<GatewayRef> TopologicalMap::leads_to(GatewayRef at) const {
  const GatewayRef other = exit(at);
  return other.place.is_valid() ? std::optional(other) : std::nullopt;
}

std::optional<GatewayRef> TopologicalMap::linked_to(GatewayRef at) const {
  const GatewayRef other = exit(at);
  return other.place.is_valid() && exit(other) == at ? std::optional(other) : std::nullopt;
}

std::vector<GatewayRef> TopologicalMap::pending_gateways() const {
  std::vector<GatewayRef> pending;
  pending.reserve(static_cast<std::size_t>(pending_count_));
  for (GatewayRef at{{0}, 0}; at.place.value < place_count(); ++at.place.value) {
    const int gateways = gateway_count(at.place);
    for (at.gateway = 0; at.gateway < gateways; ++at.gateway) {
      if (is_pending(at)) {
        pending.push_back(at);
      }
    }
  }
  return pending;
}

GatewayRef TopologicalMap::departure(Action action) const {
  const int gateways = gateway_count(position_.place);
  CAIRN_CHECK(action.turn >= 0 && action.turn < gateways);
  return {position_.place, (position_.gateway + action.turn) % gateways};
}

bool TopologicalMap::has_no_lone_path() const {
  for (GatewayRef at{{0}, 0}; at.place.value < place_count(); ++at.place.value) {
    for (at.gateway = 0; at.gateway < gateway_count(at.place); ++at.gateway) {
      const std::optional<GatewayRef> other = through(at);
      if (!linked_to(at) && (!other || !linked_to(*other))) {
        return false;
      }
    }
  }
  return true;
}

void TopologicalMap::follow(GatewayRef departure, const Arrival& arrival) {
  CAIRN_CHECK(!is_pending(departure));
  move_to(exit(departure), arrival);
}

void TopologicalMap::close(GatewayRef departure, GatewayRef target, const Arrival& arrival) {
  CAIRN_CHECK(is_pending(departure) && is_pending(target) && departure != target);
  link(departure, target);
  ++closure_count_;
  move_to(target, arrival);
}

void TopologicalMap::add_place(GatewayRef departure, const Arrival& arrival) {
  CAIRN_CHECK(is_pending(departure));
  const GatewayRef target = append_place(arrival, component(departure.place));
  link(departure, target);
  move_to(target, arrival);
}

void TopologicalMap::add_contradicting_place(GatewayRef departure, const Arrival& arrival) {
  // A component is named by its first place, so no two parts share a number.
  const GatewayRef target = append_place(arrival, place_count());
  ++component_count_;
  exits_[exit_index(target)] = departure;
  --pending_count_;
  ++unexplained_count_;
  move_to(target, arrival);
}

void TopologicalMap::rejoin(GatewayRef departure, GatewayRef target, const Arrival& arrival) {
  CAIRN_CHECK(!is_pending(target));
  if (is_pending(departure)) {
    exits_[exit_index(departure)] = target;
    --pending_count_;
    ++unexplained_count_;
  }
  move_to(target, arrival);
}

GatewayRef TopologicalMap::append_place(const Arrival& arrival, int component) {
  const PlaceId place{static_cast<std::int32_t>(places_.size())};
  places_.push_back({arrival.star, exits_.size(), component, arrival.visit});
  const int gateways = stars_->gateway_count(arrival.star);
  exits_.resize(exits_.size() + static_cast<std::size_t>(gateways));
  pending_count_ += gateways;
  path_count_ += stars_->fragment_count(arrival.star);
  return {place, arrival.gateway};
}

void TopologicalMap::link(GatewayRef a, GatewayRef b) {
  exits_[exit_index(a)] = b;
  exits_[exit_index(b)] = a;
  pending_count_ -= 2;
  // Two different paths become one; the axiom rules out joining a path to itself.
  --path_count_;
  const std::int32_t kept = component(a.place);
  const std::int32_t merged = component(b.place);
  if (kept != merged) {
    --component_count_;
    for (Place& place : places_) {
      place.component = place.component == merged ? kept : place.component;
    }
  }
}

void TopologicalMap::move_to(GatewayRef target, const Arrival& arrival) {
  CAIRN_CHECK(arrival.visit.index() == visits_.size());
  const int gateways = gateway_count(target.place);
  CAIRN_CHECK(stars_->gateway_count(arrival.star) == gateways);
  position_ = target;
  visits_.push_back({target.place, (target.gateway - arrival.gateway + gateways) % gateways});
}

}  // namespace cairn
