#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "topology/experience.hpp"
#include "topology/star_catalogue.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// A view whose star is known to the catalogue.
struct Arrival {
  StarId star;
  int gateway = 0;  ///< Of that star.
  VisitId visit;
};

/// Which place a visit was at, according to one map.
struct VisitedPlace {
  PlaceId place;
  /// The gateway of arrival is gateway (arrival + shift) mod n of the place's star; unless the
  /// visit misread the star, so is every gateway.
  int shift = 0;
  friend bool operator==(const VisitedPlace&, const VisitedPlace&) = default;
};

/// One topological map <M, x> and the robot's position in it: places with their stars, links
/// between gateways, and which place every visit was at. A gateway that nobody went through is
/// pending (Savelli and Kuipers, IROS 2004). Symbols only: the map knows neither poses nor
/// distances.
///
/// A link joins two gateways. Where an observation contradicted the map, a gateway may instead lead
/// one way, to a gateway that is linked elsewhere: such a gateway is unexplained. It belongs to no
/// path and to no face, but the robot may travel through it.
///
/// Where a visit misread the star, or carried several readings, the map knows which of its gateways
/// is which of the place's.
///
/// A value: copies are independent (the stars are shared, and never change).
class TopologicalMap {
 public:
  /// One place, all gateways pending, the robot in it.
  TopologicalMap(std::shared_ptr<const StarCatalogue> stars, const Arrival& arrival);

  /// A visit as another representation of the map knows it.
  struct PlacedVisit {
    GatewayRef arrival;
    int arrival_of_view = 0;  ///< The gateway of arrival in the numbers of the view.
    /// For each gateway of the view that of the place, -1: none; empty: all follow clockwise.
    std::vector<int> gateways;
    bool is_carried = false;  ///< Not by a travel from the visit before.
  };
  /// The map as a search holds it. @pre the visits are all, in order, at places of the map
  TopologicalMap(std::shared_ptr<const StarCatalogue> stars,
                 const WorkingMap& map,
                 const std::vector<PlacedVisit>& visits);

  [[nodiscard]] int place_count() const { return static_cast<int>(places_.size()); }
  /// Chains of fragments, each joined to the next by a link.
  [[nodiscard]] int path_count() const { return path_count_; }
  [[nodiscard]] int pending_count() const { return pending_count_; }
  [[nodiscard]] int closure_count() const { return closure_count_; }
  [[nodiscard]] int visit_count() const { return static_cast<int>(visits_.size()); }
  /// Parts without a link between them: 1 unless an observation contradicted the map.
  [[nodiscard]] int component_count() const { return component_count_; }

  [[nodiscard]] const Star& star(PlaceId place) const { return stars_->star(star_of(place)); }
  [[nodiscard]] int gateway_count(PlaceId place) const {
    return stars_->gateway_count(star_of(place));
  }
  [[nodiscard]] int gateway_count(const Arrival& arrival) const {
    return stars_->gateway_count(arrival.star);
  }
  [[nodiscard]] ViewClassId view_class(GatewayRef at) const {
    return stars_->view_class(star_of(at.place), at.gateway);
  }
  [[nodiscard]] ViewClassId view_class(const Arrival& arrival) const {
    return stars_->view_class(arrival.star, arrival.gateway);
  }
  [[nodiscard]] std::size_t slot_of(GatewayRef at) const {
    return stars_->slot_of(star_of(at.place), at.gateway);
  }
  /// The gateway straight on from this one across its place.
  [[nodiscard]] std::optional<GatewayRef> through(GatewayRef at) const;
  /// Equal for places that links connect.
  [[nodiscard]] int component(PlaceId place) const { return places_[place.index()].component; }

  [[nodiscard]] bool is_pending(GatewayRef at) const { return !exit(at).place.is_valid(); }
  /// Where a travel through this gateway is known to end: one way or linked.
  [[nodiscard]] std::optional<GatewayRef> leads_to(GatewayRef at) const;
  /// The gateway at the other end of the link.
  [[nodiscard]] std::optional<GatewayRef> linked_to(GatewayRef at) const;
  /// Leads somewhere, but not by a link.
  [[nodiscard]] bool is_unexplained(GatewayRef at) const {
    return !is_pending(at) && !linked_to(at).has_value();
  }
  [[nodiscard]] int unexplained_count() const { return unexplained_count_; }
  /// By place, then gateway.
  [[nodiscard]] std::vector<GatewayRef> pending_gateways() const;

  /// Where the robot is: the place, and the gateway it came in by.
  [[nodiscard]] GatewayRef position() const { return position_; }
  /// The gateway by which an action leaves.
  [[nodiscard]] GatewayRef departure(Action action) const;
  /// @pre visit.index() < visit_count()
  [[nodiscard]] VisitedPlace at_visit(VisitId visit) const { return visits_[visit.index()]; }
  /// The gateway of the visit's place that the view calls `gateway`; -1 where the place has none.
  [[nodiscard]] int gateway_at(VisitId visit, int gateway) const;
  /// Whether the robot did not travel here from the visit before.
  [[nodiscard]] bool is_carried(VisitId visit) const { return carried_.count(visit) > 0; }
  /// The visit that made the place known.
  [[nodiscard]] VisitId first_visit(PlaceId place) const {
    return places_[place.index()].first_visit;
  }

  /// No gateway is pending.
  [[nodiscard]] bool is_closed() const { return pending_count_ == 0; }
  /// No path is known from one place only: what Fig. 4 of Savelli and Kuipers counts as closed.
  [[nodiscard]] bool has_no_lone_path() const;

  // What an arrival can do to a map. The visit must be the next one.

  /// The robot came out where the departing gateway is known to lead.
  void follow(GatewayRef departure, const Arrival& arrival);
  /// The robot came out at a known place through a gateway that was pending, as the departing one
  /// was.
  void close(GatewayRef departure, GatewayRef target, const Arrival& arrival);
  /// The robot came to a new place. @pre departure is pending
  void add_place(GatewayRef departure, const Arrival& arrival);
  /// The robot came to a new place although the departing gateway leads elsewhere: the gateway of
  /// arrival is left unexplained.
  void add_contradicting_place(GatewayRef departure, const Arrival& arrival);
  /// The robot came out at a known place through a gateway that is linked elsewhere. The departing
  /// gateway is left unexplained if it was pending, and leads where it led if not.
  void rejoin(GatewayRef departure, GatewayRef target, const Arrival& arrival);

  /// Later arrivals may bring stars that this map's catalogue lacks.
  /// @pre stars holds everything that the present catalogue holds, under the same ids
  void refer_to(std::shared_ptr<const StarCatalogue> stars) { stars_ = std::move(stars); }

 private:
  struct Place {
    StarId star;
    std::size_t first_exit = 0;  ///< Position of its gateway 0 in exits_.
    std::int32_t component = 0;
    VisitId first_visit;
  };

  [[nodiscard]] StarId star_of(PlaceId place) const { return places_[place.index()].star; }
  [[nodiscard]] std::size_t exit_index(GatewayRef at) const {
    return places_[at.place.index()].first_exit + static_cast<std::size_t>(at.gateway);
  }
  [[nodiscard]] GatewayRef exit(GatewayRef at) const { return exits_[exit_index(at)]; }
  GatewayRef append_place(const Arrival& arrival, int component);
  void link(GatewayRef a, GatewayRef b);
  void move_to(GatewayRef target, const Arrival& arrival);

  std::shared_ptr<const StarCatalogue> stars_;  // Shared by all maps of a tree; immutable.
  std::vector<Place> places_;
  std::vector<GatewayRef> exits_;  // Where each gateway leads; an invalid place: pending.
  std::vector<VisitedPlace> visits_;
  std::map<VisitId, std::vector<int>> misread_;  // Gateways by gateway of the view.
  std::set<VisitId> carried_;
  GatewayRef position_;
  int path_count_ = 0;
  int pending_count_ = 0;
  int closure_count_ = 0;
  int component_count_ = 1;
  int unexplained_count_ = 0;
};

}  // namespace cairn
