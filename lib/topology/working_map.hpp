#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/star_catalogue.hpp"

namespace cairn {

/// Position of a gateway in the list of all gateways of a map. A place's gateways follow each other
/// clockwise; places come in the order in which they were met. Nodes of a tree that have a common
/// ancestor therefore agree on the gateways that it had.
using GatewayIndex = std::int32_t;
constexpr GatewayIndex kNoGateway = -1;

/// How a map grows by one arrival: what a search may do, and undo.
struct MapChange {
  enum class Kind : std::uint8_t {
    kNothing,      ///< The robot only moved; also the start.
    kPlace,        ///< A new place, linked to a pending gateway.
    kLink,         ///< Two pending gateways are linked: a loop closes.
    kStrayPlace,   ///< A new place without a link; its gateway of arrival leads one way.
    kOneWay,       ///< A pending gateway leads one way, to a gateway that is linked elsewhere.
    kOtherStar,    ///< A place gets another star, with the same gateways.
    kInsertPlace,  ///< A place is put into a link, one of its fragments along it.
  };
  Kind kind = Kind::kNothing;
  StarId star;  ///< Of the place that is added or changed.
  VisitId visit;
  GatewayIndex departure = kNoGateway;  ///< By which the robot left; of the place for kOtherStar.
  /// The gateway that is linked or led to; the number of the gateway of arrival in `star` where a
  /// place is added.
  GatewayIndex target = kNoGateway;
};

[[nodiscard]] constexpr bool adds_place(const MapChange& change) {
  return change.kind == MapChange::Kind::kPlace || change.kind == MapChange::Kind::kStrayPlace ||
         change.kind == MapChange::Kind::kInsertPlace;
}

/// A visit to a place of a map.
struct VisitRecord {
  VisitId visit;
  std::int32_t number = 0;     ///< Of the gateway of arrival, in the star that the place has now.
  std::int32_t previous = -1;  ///< The record of the visit before to the same place; -1: none.
};

/// One topological map as a search changes it, step by step forward and back: places, links, and
/// the pending gateways of each face as a ring. Every step and its undo take constant time (plus
/// the gateways of the place added). Symbols only. The robot's position is not part of it.
///
/// The rings hold the pending gateways of each face clockwise (face tracking, Savelli and Kuipers,
/// IROS 2004, Sec. V): a new place puts its other gateways where the departing one was; a link cuts
/// its ring in two, or joins the rings of two parts of the map. Without planarity one ring holds
/// all pending gateways, in no order.
class WorkingMap {
 public:
  enum class Rings : std::uint8_t { kFaces, kOne };

  /// @param stars outlives the map; it may grow
  WorkingMap(const StarCatalogue& stars, Rings rings) : stars_(&stars), rings_(rings) {}

  /// One place, all gateways pending. @pre the map is empty
  void start(StarId star, VisitId visit) { append_place(star, visit, next_component_++); }

  /// @pre the change is possible: what is linked is pending, indices exist
  void apply(const MapChange& change);
  /// Takes back the last change that is not taken back yet. @pre it is this one
  void undo(const MapChange& change);

  /// The robot has come to a place by this gateway.
  void record_visit(GatewayIndex position, VisitId visit);
  /// Takes back the last record that is not taken back yet. @pre it is of this place
  void forget_last_visit(PlaceId place);
  /// Of the last visit recorded; -1: none is.
  [[nodiscard]] std::int32_t latest_record(PlaceId place) const {
    return places_[place.index()].latest_record;
  }
  /// Valid until the map is changed.
  [[nodiscard]] const VisitRecord& record(std::int32_t index) const {
    return records_[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] int place_count() const { return static_cast<int>(places_.size()); }
  /// The index that the first gateway of the next place will have.
  [[nodiscard]] GatewayIndex end_gateway() const {
    return static_cast<GatewayIndex>(gateways_.size());
  }
  /// Chains of fragments, each joined to the next by a link.
  [[nodiscard]] int path_count() const { return path_count_; }
  [[nodiscard]] int pending_count() const { return pending_count_; }
  /// Gateways that lead one way only.
  [[nodiscard]] int one_way_count() const { return one_way_count_; }
  /// Parts without a link between them.
  [[nodiscard]] int component_count() const { return component_count_; }

  /// Parts that were ever begun: places added without a link, and the first one.
  [[nodiscard]] int parts_begun() const { return next_component_; }

  [[nodiscard]] StarId star(PlaceId place) const { return places_[place.index()].star; }
  /// The visit that showed the place's star.
  [[nodiscard]] VisitId seen_at(PlaceId place) const { return places_[place.index()].seen_at; }
  [[nodiscard]] VisitId first_visit(PlaceId place) const {
    return places_[place.index()].first_visit;
  }
  [[nodiscard]] int component(PlaceId place) const { return places_[place.index()].component; }
  [[nodiscard]] int gateway_count(PlaceId place) const {
    return stars_->gateway_count(places_[place.index()].star);
  }
  [[nodiscard]] GatewayIndex first_gateway(PlaceId place) const {
    return places_[place.index()].first_gateway;
  }
  [[nodiscard]] GatewayIndex gateway(GatewayRef at) const {
    return first_gateway(at.place) + at.gateway;
  }

  [[nodiscard]] PlaceId place_of(GatewayIndex at) const { return {of(at).place}; }
  /// Its number among the gateways of its place.
  [[nodiscard]] int number_of(GatewayIndex at) const { return at - first_gateway(place_of(at)); }
  [[nodiscard]] GatewayRef ref(GatewayIndex at) const { return {place_of(at), number_of(at)}; }
  /// Where a travel through this gateway ends, by a link or one way; kNoGateway: pending.
  [[nodiscard]] GatewayIndex leads_to(GatewayIndex at) const { return of(at).leads_to; }
  [[nodiscard]] bool is_pending(GatewayIndex at) const { return of(at).leads_to == kNoGateway; }
  [[nodiscard]] bool is_linked(GatewayIndex at) const {
    return !is_pending(at) && of(of(at).leads_to).leads_to == at;
  }
  /// The gateway straight on across the place; kNoGateway: the fragment terminates.
  [[nodiscard]] GatewayIndex through(GatewayIndex at) const { return of(at).through; }
  [[nodiscard]] ViewClassId view_class(GatewayIndex at) const { return {of(at).view_class}; }
  /// The pending gateway that follows clockwise in the ring. @pre at is pending
  [[nodiscard]] GatewayIndex next_in_ring(GatewayIndex at) const { return of(at).next; }
  [[nodiscard]] GatewayIndex previous_in_ring(GatewayIndex at) const { return of(at).previous; }

  [[nodiscard]] const StarCatalogue& stars() const { return *stars_; }
  [[nodiscard]] Rings rings() const { return rings_; }
  /// Memory that it holds.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Gateway {
    std::int32_t place = -1;
    GatewayIndex leads_to = kNoGateway;
    GatewayIndex through = kNoGateway;
    GatewayIndex next = kNoGateway;  ///< In the ring; kept while the gateway is out of it.
    GatewayIndex previous = kNoGateway;
    std::int32_t view_class = -1;
  };
  struct Place {
    StarId star;
    GatewayIndex first_gateway = 0;
    std::int32_t component = 0;
    VisitId first_visit;
    VisitId seen_at;
    std::int32_t latest_record = -1;
  };
  /// What a rare change overwrote.
  struct Saved {
    PlaceId place;
    std::int32_t value = 0;
  };

  [[nodiscard]] Gateway& of(GatewayIndex at) { return gateways_[static_cast<std::size_t>(at)]; }
  [[nodiscard]] const Gateway& of(GatewayIndex at) const {
    return gateways_[static_cast<std::size_t>(at)];
  }

  GatewayIndex append_place(StarId star, VisitId visit, std::int32_t component);
  void remove_last_place();
  void fill_from_star(GatewayIndex first, StarId star);
  void leave_ring(GatewayIndex at);
  void rejoin_ring(GatewayIndex at);
  [[nodiscard]] bool is_in_ring(GatewayIndex at) const;
  [[nodiscard]] GatewayIndex clockwise_of(GatewayIndex at) const;
  void enter_ring(GatewayIndex at);

  void add_place(const MapChange& change);
  void remove_place(const MapChange& change);
  void link(GatewayIndex a, GatewayIndex b);
  void unlink(GatewayIndex a, GatewayIndex b);
  void join_components(GatewayIndex a, GatewayIndex b);
  void part_components();
  void add_stray_place(const MapChange& change);
  void remove_stray_place(const MapChange& change);
  void change_star(const MapChange& change);
  void restore_star(const MapChange& change);
  void move_gateway(GatewayIndex from, GatewayIndex to);
  void renumber_records(Place& place, int before, const MapChange& change);
  void restore_records(Place& place);
  void insert_place(const MapChange& change);
  void take_out_place(const MapChange& change);

  const StarCatalogue* stars_;
  Rings rings_;
  std::vector<Gateway> gateways_;
  std::vector<Place> places_;
  std::vector<Saved> saved_;
  std::vector<VisitRecord> records_;
  int path_count_ = 0;
  int pending_count_ = 0;
  int one_way_count_ = 0;
  int component_count_ = 0;
  std::int32_t next_component_ = 0;
};

}  // namespace cairn
