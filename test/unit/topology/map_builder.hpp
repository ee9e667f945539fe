#pragma once

#include <memory>

#include "topology/topological_map.hpp"

namespace cairn::test {

/// Builds one map by hand, visit by visit.
class MapBuilder {
 public:
  MapBuilder(const Star& star, int arrival_gateway)
      : stars_(catalogue_of(star)), map_(stars_, {StarId{0}, arrival_gateway, VisitId{0}}) {}

  [[nodiscard]] const TopologicalMap& map() const { return map_; }

  /// Leaves by (arrival + turn), comes to a new place.
  MapBuilder& add_place(int turn, const Star& star, int arrival_gateway) {
    const Arrival arrival = arrive(star, arrival_gateway);
    map_.add_place(map_.departure({turn}), arrival);
    return *this;
  }
  MapBuilder& close(int turn, GatewayRef target) {
    const Arrival arrival = arrive(map().star(target.place), target.gateway);
    map_.close(map_.departure({turn}), target, arrival);
    return *this;
  }
  MapBuilder& follow(int turn, const Star& star, int arrival_gateway) {
    const Arrival arrival = arrive(star, arrival_gateway);
    map_.follow(map_.departure({turn}), arrival);
    return *this;
  }
  MapBuilder& contradict(int turn, const Star& star, int arrival_gateway) {
    const Arrival arrival = arrive(star, arrival_gateway);
    map_.add_contradicting_place(map_.departure({turn}), arrival);
    return *this;
  }
  MapBuilder& rejoin(int turn, GatewayRef target) {
    const Arrival arrival = arrive(map().star(target.place), target.gateway);
    map_.rejoin(map_.departure({turn}), target, arrival);
    return *this;
  }

  /// A view of the next visit, known to the map.
  Arrival arrive(const Star& star, int arrival_gateway) {
    auto extended = std::make_shared<StarCatalogue>(*stars_);
    const StarId id = extended->add(star);
    stars_ = std::move(extended);
    map_.refer_to(stars_);
    return {id, arrival_gateway, VisitId{map_.visit_count()}};
  }

 private:
  static std::shared_ptr<const StarCatalogue> catalogue_of(const Star& star) {
    StarCatalogue stars;
    stars.add(star);
    return std::make_shared<const StarCatalogue>(stars);
  }

  std::shared_ptr<const StarCatalogue> stars_;
  TopologicalMap map_;
};

/// Four corners, the robot always turning right.
inline MapBuilder square(const Star& corner) {
  return MapBuilder(corner, 0)
      .add_place(0, corner, 1)
      .add_place(1, corner, 1)
      .add_place(1, corner, 1)
      .close(1, {PlaceId{0}, 1});
}

}  // namespace cairn::test
