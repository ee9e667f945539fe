#pragma once

#include <utility>
#include <vector>

#include "topology/successors.hpp"

namespace cairn::test {

/// One working map, changed visit by visit as a hypothesis would, that is asked what the next
/// arrival may mean to it.
class Arrivals {
 public:
  Arrivals(const Star& star,
           int arrival_gateway,
           const TopologyOptions& options = {},
           Evidence evidence = {},
           WorkingMap::Rings rings = WorkingMap::Rings::kFaces)
      : options_(options),
        evidence_(std::move(evidence)),
        experience_(stars_,
                    {options.log_penalty_misread, options.log_penalty_missed_gateway,
                     options.log_penalty_false_gateway}),
        map_(stars_, rings),
        successors_(options_, evidence_, experience_, stars_, map_) {
    experience_.add({}, {star, arrival_gateway, VisitId{0}}, false);
    map_.start(experience_.matcher(VisitId{0}).star_id(0), VisitId{0});
    position_ = arrival_gateway;
    map_.record_visit(position_, VisitId{0});
  }
  // The successors point to what lies beside them.
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  /// Travels and takes the arrival for a new place.
  Arrivals& add_place(int turn, const Star& star, int arrival_gateway) {
    return take(arrive(turn, star, arrival_gateway), MapChange::Kind::kPlace, arrival_gateway);
  }
  Arrivals& close(int turn, GatewayRef target) {
    const Star& star = stars_.star(map_.star(target.place));
    return take(arrive(turn, star, target.gateway), MapChange::Kind::kLink, map_.gateway(target));
  }
  /// Along a known link.
  Arrivals& follow(int turn, const Star& star, int arrival_gateway) {
    position_ = map_.leads_to(arrive(turn, star, arrival_gateway));
    map_.record_visit(position_, VisitId{experience_.size() - 1});
    return *this;
  }
  /// At a new place although the gateway leads elsewhere.
  Arrivals& contradict(int turn, const Star& star, int arrival_gateway) {
    return take(arrive(turn, star, arrival_gateway), MapChange::Kind::kStrayPlace, arrival_gateway);
  }

  /// All that the next arrival may mean, refuted or not.
  std::vector<Alternative> of(int turn, const Star& star, int arrival_gateway) {
    arrive(turn, star, arrival_gateway);
    return of_last();
  }
  std::vector<Alternative> of(int turn, View view) {
    view.visit = VisitId{experience_.size()};
    experience_.add({turn}, view, false);
    return of_last();
  }
  /// The same arrival again, an operator having spoken.
  std::vector<Alternative> of_last(PlaceOrder order = {}) {
    std::vector<Alternative> found;
    successors_.list({position_, VisitId{experience_.size() - 1}, std::move(order)},
                     Successors::Detail::kAll, found);
    return found;
  }
  /// The same arrival again, which may have led anywhere.
  std::vector<Alternative> of_last_anywhere() {
    successors_.allow_rejoining(VisitId{experience_.size() - 1});
    return of_last();
  }
  [[nodiscard]] GatewayRef position() const { return map_.ref(position_); }
  [[nodiscard]] const WorkingMap& map() const { return map_; }
  /// The map after this alternative.
  WorkingMap& after(const Alternative& alternative) {
    map_.apply(alternative.amendment);
    map_.apply(alternative.change);
    return map_;
  }

 private:
  GatewayIndex arrive(int turn, const Star& star, int arrival_gateway) {
    const VisitId visit{experience_.size()};
    experience_.add({turn}, {star, arrival_gateway, visit}, false);
    return experience_.departure(map_, position_, VisitId{visit.value - 1}, {turn});
  }
  Arrivals& take(GatewayIndex departure, MapChange::Kind kind, int target) {
    const VisitId visit{experience_.size() - 1};
    const GatewayIndex end = map_.end_gateway();
    map_.apply({kind, experience_.matcher(visit).star_id(0), visit, departure, target});
    position_ = kind == MapChange::Kind::kLink ? target : end + target;
    map_.record_visit(position_, visit);
    return *this;
  }

  TopologyOptions options_;
  Evidence evidence_;
  StarCatalogue stars_;
  ExperienceLog experience_;
  WorkingMap map_;
  Successors successors_;
  GatewayIndex position_ = kNoGateway;
};

}  // namespace cairn::test
