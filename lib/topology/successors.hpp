#pragma once

#include <string_view>
#include <vector>

#include "topology/evidence.hpp"
#include "topology/topological_map.hpp"
#include "topology/topology_options.hpp"

namespace cairn {

/// What an arrival means to a map.
enum class StepKind {
  kStart,      ///< The first place.
  kKnownLink,  ///< The place to which the departing gateway is known to lead.
  kClosure,    ///< A known place, through a pending gateway: a loop closes.
  kNewPlace,   ///< A place never seen before.
  kMisread,    ///< The known link's place, although the star differs: evidence overrules it.
  /// A known place through a gateway that leads elsewhere: evidence overrules the link, or the
  /// gateway was left unexplained by a travel the other way.
  kRejoin,
  kContradiction,  ///< A place that the departing gateway should not lead to: a break.
};

/// Why a step is not possible.
enum class Refutation {
  kNone,              ///< It is possible.
  kOtherView,         ///< The star, seen from the gateway, differs.
  kOtherFace,         ///< The link would cross a path segment.
  kPlaceTwiceOnPath,  ///< Axiom: no place twice on a path.
  kRegions,           ///< A place would lie on both sides of a path, or on a path and beside it.
  kEvidence,          ///< Evidence says minus infinity.
  kTooManyPlaces,     ///< TopologyOptions::max_places.
};

/// One step of a hypothesis.
struct Step {
  StepKind kind = StepKind::kStart;
  GatewayRef departure;
  GatewayRef target;  ///< Gateway of arrival at a known place; no place for a new one.
};

/// A step that was considered.
struct Alternative {
  Step step;
  Refutation refuted_by = Refutation::kNone;
  double log_likelihood = 0.0;  ///< Prior, evidence and penalties of this step; not the layout.
};

/// Everything a travel may have led to according to one map, possible or not: Fig. 4, steps 1 to 3
/// of Kuipers et al., ICRA 2004, with (2c) of Savelli and Kuipers when planar. From a known link:
/// that place, if the view agrees. From a pending gateway: every pending gateway, by place, then
/// the new place. Breaks are not among them.
[[nodiscard]] std::vector<Alternative> alternatives(const TopologicalMap& map,
                                                    Action action,
                                                    const Arrival& arrival,
                                                    const TopologyOptions& options,
                                                    const Evidence& evidence);

/// Carries out a step.
void apply(const Step& step, const Arrival& arrival, TopologicalMap& map);

/// "known link", "closure", ...
[[nodiscard]] std::string_view name_of(StepKind kind);
/// "the view differs", ...: completes "refuted: ".
[[nodiscard]] std::string_view reason_of(Refutation refutation);

}  // namespace cairn
