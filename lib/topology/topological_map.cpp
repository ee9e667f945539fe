#include "topology/topological_map.hpp"

#include <utility>

#include "base/check.hpp"

namespace cairn {

TopologicalMap::TopologicalMap(std::shared_ptr<const StarCatalogue> stars, const Arrival& arrival)
    : stars_(std::move(stars)) {
  move_to(append_place(arrival, 0), arrival);
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
