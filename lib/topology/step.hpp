#pragma once

#include <cstdint>
#include <string_view>

#include "topology/ids.hpp"

namespace cairn {

/// What an arrival means to a map.
enum class StepKind : std::uint8_t {
  kStart,      ///< The first place.
  kKnownLink,  ///< The place to which the departing gateway is known to lead.
  kClosure,    ///< A known place, through a pending gateway: a loop closes.
  kNewPlace,   ///< A place never seen before.
  kMisread,    ///< A known place although this visit's star differs: this visit misread it.
  kAmended,    ///< A known place whose star was misread before: it is corrected.
  kUnnoticed,  ///< Beyond a known place that the robot passed without noticing it.
  kInserted,   ///< A new place on a known link: earlier travels passed it without notice.
  /// A known place through a gateway that leads elsewhere: evidence overrules the link, or the
  /// gateway was left unexplained by a travel the other way.
  kRejoin,
  kBranch,         ///< A new place, off a known link by a junction that nobody noticed.
  kContradiction,  ///< A place that the departing gateway should not lead to: a break.
  kRelocated,      ///< Carried, or woken up, at a known place.
  kElsewhere,      ///< Carried, or woken up, at a place that no part of the map holds.
};
constexpr int kStepKinds = 13;

/// Whether the step blames an observation, or leaves it unexplained.
[[nodiscard]] constexpr bool is_contradiction(StepKind kind) {
  return kind == StepKind::kMisread || kind == StepKind::kAmended || kind == StepKind::kUnnoticed ||
         kind == StepKind::kInserted || kind == StepKind::kRejoin || kind == StepKind::kBranch ||
         kind == StepKind::kContradiction;
}

/// Why a step is not possible.
enum class Refutation : std::uint8_t {
  kNone,              ///< It is possible.
  kOtherView,         ///< The star, seen from the gateway, differs.
  kOtherFace,         ///< The link would cross a path segment.
  kPlaceTwiceOnPath,  ///< Axiom: no place twice on a path.
  kRegions,           ///< A place would lie on both sides of a path, or on a path and beside it.
  kEvidence,          ///< Evidence says minus infinity.
  kTooManyPlaces,     ///< TopologyOptions::max_places.
  kOperator,          ///< An operator says otherwise.
};
constexpr int kRefutations = 8;

/// One step of a hypothesis.
struct Step {
  StepKind kind = StepKind::kStart;
  GatewayRef departure;  ///< No place where the robot was carried.
  GatewayRef target;     ///< Gateway of arrival at a known place; no place for a new one.
};

/// "known link", "closure", ...
[[nodiscard]] std::string_view name_of(StepKind kind);
/// "the view differs", ...: completes "refuted: ".
[[nodiscard]] std::string_view reason_of(Refutation refutation);

}  // namespace cairn
