#include "topology/successors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "topology/paths.hpp"
#include "topology/planarity.hpp"
#include "topology/regions.hpp"

namespace cairn {
namespace {

/// Judges what one travel may have led to. What depends on the departing gateway alone is found
/// once.
class Judge {
 public:
  Judge(const TopologicalMap& map,
        GatewayRef departure,
        const Arrival& arrival,
        const TopologyOptions& options,
        const Evidence& evidence)
      : map_(map),
        departure_(departure),
        arrival_(arrival),
        options_(options),
        evidence_(evidence) {}

  [[nodiscard]] std::vector<Alternative> at_known_link(GatewayRef target) const {
    Alternative known{{StepKind::kKnownLink, departure_, target}};
    if (sees(target)) {
      known.log_likelihood = recognition(target);
      refute_by_evidence(known);
    } else {
      known.refuted_by = Refutation::kOtherView;
    }
    std::vector<Alternative> all = {known};
    if (known.refuted_by == Refutation::kOtherView) {
      consider_misreading(target, all);
    }
    if (map_.unexplained_count() > 0) {
      consider_unexplained(target, all);
    }
    return all;
  }

  [[nodiscard]] std::vector<Alternative> at_pending_gateway() {
    own_path_ = places_behind(map_, departure_);
    if (options_.planar) {
      own_face_ = pending_on_face(map_, departure_);
      std::sort(own_face_.begin(), own_face_.end());
    }
    std::vector<Alternative> all;
    for (GatewayRef at{{0}, 0}; at.place.value < map_.place_count(); ++at.place.value) {
      const int gateways = map_.gateway_count(at.place);
      for (at.gateway = 0; at.gateway < gateways; ++at.gateway) {
        if (at == departure_) {
          continue;
        }
        if (map_.is_pending(at)) {
          consider_closing(at, all);
        } else {
          consider_rejoining(at, all);
        }
      }
    }
    all.push_back(new_place());
    return all;
  }

 private:
  [[nodiscard]] bool sees(GatewayRef target) const {
    return map_.view_class(target) == map_.view_class(arrival_);
  }

  [[nodiscard]] double recognition(GatewayRef target) const {
    if (!evidence_.same_place) {
      return 0.0;
    }
    const int gateways = map_.gateway_count(target.place);
    const int shift = (target.gateway - arrival_.gateway + gateways) % gateways;
    const double ratio = evidence_.same_place(map_, arrival_.visit, target.place, shift);
    CAIRN_CHECK(ratio < std::numeric_limits<double>::infinity());  // NaN compares false.
    return ratio;
  }

  static void refute_by_evidence(Alternative& alternative) {
    if (std::isinf(alternative.log_likelihood) && alternative.log_likelihood < 0.0) {
      alternative.refuted_by = Refutation::kEvidence;
    }
  }

  void consider_closing(GatewayRef target, std::vector<Alternative>& all) const {
    Alternative closure{{StepKind::kClosure, departure_, target}};
    if (!sees(target)) {
      closure.refuted_by = Refutation::kOtherView;
      all.push_back(closure);
      if (evidence_.same_place && has_as_many_gateways(target.place) &&
          refutation_of_link(target) == Refutation::kNone) {
        consider_misreading(target, all);
      }
      return;
    }
    closure.refuted_by = refutation_of_link(target);
    if (closure.refuted_by == Refutation::kNone) {
      closure.log_likelihood = recognition(target);
      refute_by_evidence(closure);
    }
    all.push_back(closure);
  }

  [[nodiscard]] Refutation refutation_of_link(GatewayRef target) const {
    if (options_.planar && map_.component(target.place) == map_.component(departure_.place) &&
        !std::binary_search(own_face_.begin(), own_face_.end(), target)) {
      return Refutation::kOtherFace;
    }
    const std::vector<PlaceId> other_path = places_behind(map_, target);
    if (std::find_first_of(other_path.begin(), other_path.end(), own_path_.begin(),
                           own_path_.end()) != other_path.end()) {
      return Refutation::kPlaceTwiceOnPath;
    }
    if (options_.region_consistent) {
      TopologicalMap closed = map_;
      closed.close(departure_, target, arrival_);
      if (!is_region_consistent(closed)) {
        return Refutation::kRegions;
      }
    }
    return Refutation::kNone;
  }

  /// A shift between the gateways is defined only where their numbers agree.
  [[nodiscard]] bool has_as_many_gateways(PlaceId place) const {
    return map_.gateway_count(place) == map_.gateway_count(arrival_);
  }

  void consider_misreading(GatewayRef target, std::vector<Alternative>& all) const {
    if (!has_as_many_gateways(target.place)) {
      return;
    }
    const double ratio = recognition(target);
    if (ratio > options_.recognition_threshold) {
      all.push_back({{StepKind::kMisread, departure_, target},
                     Refutation::kNone,
                     ratio - options_.log_penalty_misread});
    }
  }

  /// A gateway that leads here one way may also be where a travel from here ends: the corridor of
  /// an earlier contradiction.
  void consider_unexplained(GatewayRef known_target, std::vector<Alternative>& all) const {
    for (GatewayRef at{{0}, 0}; at.place.value < map_.place_count(); ++at.place.value) {
      const int gateways = map_.gateway_count(at.place);
      for (at.gateway = 0; at.gateway < gateways; ++at.gateway) {
        if (at != known_target && map_.leads_to(at) == departure_ && sees(at)) {
          Alternative again{{StepKind::kRejoin, departure_, at}};
          again.log_likelihood = recognition(at) - options_.log_penalty_misread;
          refute_by_evidence(again);
          all.push_back(again);
        }
      }
    }
  }

  void consider_rejoining(GatewayRef target, std::vector<Alternative>& all) const {
    // A map without contradictions gives no reason to doubt its links.
    if (map_.unexplained_count() == 0 || !evidence_.same_place || !sees(target)) {
      return;
    }
    const double ratio = recognition(target);
    if (ratio > options_.recognition_threshold) {
      all.push_back({{StepKind::kRejoin, departure_, target},
                     Refutation::kNone,
                     ratio - options_.log_penalty_break});
    }
  }

  [[nodiscard]] Alternative new_place() const {
    Alternative fresh{{StepKind::kNewPlace, departure_, {}}};
    fresh.log_likelihood = options_.log_prior_new_place;
    if (options_.max_places && map_.place_count() >= *options_.max_places) {
      fresh.refuted_by = Refutation::kTooManyPlaces;
    }
    return fresh;
  }

  const TopologicalMap& map_;
  const GatewayRef departure_;
  const Arrival& arrival_;
  const TopologyOptions& options_;
  const Evidence& evidence_;
  std::vector<PlaceId> own_path_;
  std::vector<GatewayRef> own_face_;
};

}  // namespace

std::vector<Alternative> alternatives(const TopologicalMap& map,
                                      Action action,
                                      const Arrival& arrival,
                                      const TopologyOptions& options,
                                      const Evidence& evidence) {
  const GatewayRef departure = map.departure(action);
  Judge judge(map, departure, arrival, options, evidence);
  const std::optional<GatewayRef> target = map.leads_to(departure);
  return target ? judge.at_known_link(*target) : judge.at_pending_gateway();
}

void apply(const Step& step, const Arrival& arrival, TopologicalMap& map) {
  switch (step.kind) {
    case StepKind::kStart:
      break;
    case StepKind::kKnownLink:
      return map.follow(step.departure, arrival);
    case StepKind::kClosure:
      return map.close(step.departure, step.target, arrival);
    case StepKind::kMisread:
      return map.is_pending(step.departure) ? map.close(step.departure, step.target, arrival)
                                            : map.follow(step.departure, arrival);
    case StepKind::kNewPlace:
      return map.add_place(step.departure, arrival);
    case StepKind::kRejoin:
      return map.rejoin(step.departure, step.target, arrival);
    case StepKind::kContradiction:
      return map.add_contradicting_place(step.departure, arrival);
  }
  CAIRN_CHECK(!"a start is not a step from a map");
}

std::string_view name_of(StepKind kind) {
  switch (kind) {
    case StepKind::kStart:
      return "start";
    case StepKind::kKnownLink:
      return "known link";
    case StepKind::kClosure:
      return "closure";
    case StepKind::kNewPlace:
      return "new place";
    case StepKind::kMisread:
      return "misread star";
    case StepKind::kRejoin:
      return "rejoining";
    case StepKind::kContradiction:
      return "break";
  }
  return "";
}

std::string_view reason_of(Refutation refutation) {
  switch (refutation) {
    case Refutation::kNone:
      return "nothing";
    case Refutation::kOtherView:
      return "the star looks different from there";
    case Refutation::kOtherFace:
      return "the link would cross a path segment (another face)";
    case Refutation::kPlaceTwiceOnPath:
      return "a place would be twice on a path (axiom)";
    case Refutation::kRegions:
      return "a place would be on both sides of a path, or on it and beside it";
    case Refutation::kEvidence:
      return "evidence excludes it";
    case Refutation::kTooManyPlaces:
      return "the map would have more than max_places places";
  }
  return "";
}

}  // namespace cairn
