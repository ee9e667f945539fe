#pragma once

#include <optional>
#include <random>
#include <vector>

#include "support/random_star.hpp"
#include "support/stars.hpp"
#include "topology/working_map.hpp"

namespace cairn::test {

/// Draws changes of every kind that a map can take.
class RandomChanges {
 public:
  explicit RandomChanges(StarCatalogue& stars) : stars_(&stars) {
    for (const Star& star : {dead_end(), corridor(), corner(), tee(), crossing()}) {
      ids_.push_back(stars.add(star));
    }
  }
  [[nodiscard]] StarId any_star(std::mt19937& random) const {
    return ids_[static_cast<std::size_t>(random_below(static_cast<int>(ids_.size()), random))];
  }

  MapChange draw(const WorkingMap& map, VisitId visit, std::mt19937& random) const {
    for (;;) {
      const auto kind = static_cast<MapChange::Kind>(1 + random_below(6, random));
      if (const std::optional<MapChange> change = draw(map, kind, visit, random)) {
        return *change;
      }
    }
  }

 private:
  [[nodiscard]] std::optional<MapChange> draw(const WorkingMap& map,
                                              MapChange::Kind kind,
                                              VisitId visit,
                                              std::mt19937& random) const {
    MapChange change{kind, any_star(random), visit, kNoGateway, kNoGateway};
    change.target = random_below(stars_->gateway_count(change.star), random);
    const std::vector<GatewayIndex> pending = gateways(map, true);
    const std::vector<GatewayIndex> linked = gateways(map, false);
    switch (kind) {
      case MapChange::Kind::kPlace:
        change.departure = any(pending, random);
        return change.departure == kNoGateway ? std::nullopt : std::optional(change);
      case MapChange::Kind::kStrayPlace:
        change.departure = random() % 2 == 0 ? kNoGateway : any(linked, random);
        return random() % 4 == 0 ? std::optional(change) : std::nullopt;
      case MapChange::Kind::kInsertPlace:
        change.departure = any(linked, random);
        return change.departure != kNoGateway && stars_->through(change.star, change.target) >= 0
                   ? std::optional(change)
                   : std::nullopt;
      case MapChange::Kind::kLink:
        change.departure = any(pending, random);
        change.target = any(pending, random);
        return change.departure == change.target ? std::nullopt : std::optional(change);
      case MapChange::Kind::kOneWay:
        change.departure = any(pending, random);
        change.target = any(linked, random);
        return change.departure == kNoGateway || change.target == kNoGateway
                   ? std::nullopt
                   : std::optional(change);
      default:
        return other_star(map, change, random);
    }
  }

  [[nodiscard]] std::optional<MapChange> other_star(const WorkingMap& map,
                                                    MapChange change,
                                                    std::mt19937& random) const {
    const PlaceId place{random_below(map.place_count(), random)};
    const int before = map.gateway_count(place);
    const int more = stars_->gateway_count(change.star) - before;
    change.departure = map.first_gateway(place);
    if (more == 0) {
      change.target = kNoGateway;
      return change;
    }
    if (more == 1) {
      change.target = 1 + random_below(before, random);  // Never the first one.
      return change;
    }
    change.target = random_below(before, random);
    const bool is_free = map.is_pending(map.first_gateway(place) + change.target);
    return more == -1 && is_free ? std::optional(change) : std::nullopt;
  }

  /// Those that lie on a link, or are pending.
  static std::vector<GatewayIndex> gateways(const WorkingMap& map, bool pending) {
    std::vector<GatewayIndex> found;
    for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
      for (int number = 0; number < map.gateway_count(place); ++number) {
        const GatewayIndex at = map.gateway({place, number});
        if (pending ? map.is_pending(at) : map.is_linked(at)) {
          found.push_back(at);
        }
      }
    }
    return found;
  }
  static GatewayIndex any(const std::vector<GatewayIndex>& from, std::mt19937& random) {
    return from.empty() ? kNoGateway
                        : from[static_cast<std::size_t>(
                              random_below(static_cast<int>(from.size()), random))];
  }

  StarCatalogue* stars_;
  std::vector<StarId> ids_;
};

/// Everything that a map tells, to be compared.
inline std::vector<int> everything_about(const WorkingMap& map) {
  std::vector<int> all = {map.place_count(),   map.path_count(),      map.pending_count(),
                          map.one_way_count(), map.component_count(), map.parts_begun(),
                          map.end_gateway()};
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    all.insert(all.end(),
               {map.star(place).value, map.seen_at(place).value, map.first_visit(place).value,
                map.component(place), map.first_gateway(place)});
    for (std::int32_t at = map.latest_record(place); at >= 0; at = map.record(at).previous) {
      all.insert(all.end(), {map.record(at).visit.value, map.record(at).number});
    }
    for (int number = 0; number < map.gateway_count(place); ++number) {
      const GatewayIndex at = map.gateway({place, number});
      all.insert(all.end(), {map.place_of(at).value, map.leads_to(at), map.through(at),
                             map.view_class(at).value});
      if (map.is_pending(at)) {
        all.insert(all.end(), {map.next_in_ring(at), map.previous_in_ring(at)});
      }
    }
  }
  return all;
}

}  // namespace cairn::test
