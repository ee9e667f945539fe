#include "topology/lineage.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace cairn {

Lineage::Lineage(const TreeNodes& nodes,
                 const ExperienceLog& experience,
                 const StarCatalogue& stars,
                 WorkingMap::Rings rings,
                 NodeIndex node)
    : nodes_(&nodes),
      experience_(&experience),
      map_(stars, rings),
      branch_(nodes.branch(node)),
      position_(nodes[branch_.front()].position) {
  const TreeNode& root = nodes[branch_.front()];
  map_.start(root.change.star, root.visit);
  map_.record_visit(position_, root.visit);
  arrivals_.push_back(map_.ref(position_));
  departures_.emplace_back();
}

void Lineage::advance() {
  const VisitId next{visit().value + 1};
  bool is_told = false;
  while (next_ < branch_.size() && (*nodes_)[branch_[next_]].visit == next) {
    take((*nodes_)[branch_[next_]]);
    ++next_;
    is_told = true;
  }
  if (!is_told) {
    const GatewayIndex departure =
        experience_->departure(map_, position_, visit(), experience_->action(next));
    CAIRN_CHECK(departure != kNoGateway && !map_.is_pending(departure));
    position_ = map_.leads_to(departure);
  }
  map_.record_visit(position_, next);
  arrivals_.push_back(map_.ref(position_));
  departures_.emplace_back();
}

void Lineage::take(const TreeNode& node) {
  if (node.is_same_map) {
    position_ = node.position;
    return;
  }
  if (node.change.kind == MapChange::Kind::kOtherStar) {
    const PlaceId place = map_.place_of(node.change.departure);
    const int before = map_.gateway_count(place);
    map_.apply(node.change);
    renumber(place, before, node.change);
  } else {
    leave(node);
    map_.apply(node.change);
  }
  if (!node.is_part) {
    position_ = node.position;
  }
}

/// Where the visit missed or imagined a gateway, only the step tells by which one the robot left.
void Lineage::leave(const TreeNode& node) {
  const GatewayIndex by =
      node.kind == StepKind::kKnownLink ? map_.leads_to(node.position) : node.change.departure;
  if (by != kNoGateway && map_.place_of(by) == arrivals_.back().place) {
    departures_.back() = map_.ref(by);
  }
}

/// A gateway more or less moves the numbers of those clockwise of it. Whoever woke up looking into
/// one that is dropped looked into none.
void Lineage::renumber(PlaceId place, int before, const MapChange& change) {
  const int gateways = map_.gateway_count(place);
  const int first_moved = change.target + (gateways < before ? 1 : 0);
  const auto move = [&](GatewayRef& used) {
    if (used.place == place && gateways != before && used.gateway >= first_moved) {
      used.gateway += gateways - before;
    }
    if (used.place == place) {
      used.gateway %= gateways;  // One that turned out not to exist: the next one clockwise.
    }
  };
  std::for_each(arrivals_.begin(), arrivals_.end(), move);
  std::for_each(departures_.begin(), departures_.end(), move);
}

}  // namespace cairn
