#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "topology/topological_map.hpp"

namespace cairn {

/// A gateway as one visit saw it.
struct SeenGateway {
  VisitId visit;
  int gateway = 0;  ///< In the numbers of the visit's first reading.
  friend auto operator<=>(const SeenGateway&, const SeenGateway&) = default;
};

/// What the world outside of symbols says about a hypothesis. Functions that are not given say
/// nothing (0). They must be pure: same arguments, same result. A NaN is a broken precondition;
/// minus infinity refutes. Natural logarithms.
///
/// Without any, or with answers of 0 and minus infinity only, the tree keeps the papers' guarantee.
struct Evidence {
  /// Log-likelihood ratio of two visits being to the same place rather than to different ones, if
  /// the two gateways are one; all others follow clockwise. For example how well the LPMs match.
  /// The first one is the visit that made the place known. Asked for every closure and known link
  /// that the symbols allow, and for places that a misread star or a wrong link may hide; for every
  /// hypothesis anew: keep the answers.
  std::function<double(SeenGateway known, SeenGateway now)> same_place;
  /// No answer about this visit exceeds it: makes the proven gap tight. Without it,
  /// TopologyOptions::max_log_evidence is taken, and greater answers are cut to it.
  std::function<double(VisitId visit)> same_place_bound;
  /// Log of how likely it is, before maps are compared, that a visit was where the known one was
  /// rather than at some other place: at most 0. The better the way between them is known, the more
  /// it says if it ends there; how far off it ends is for `layout` to say. Where it is given, a
  /// travel may have left or joined a path segment at a junction that nobody noticed
  /// (TopologyOptions::log_penalty_junction). Without it, each pending gateway is as likely as
  /// another.
  std::function<double(VisitId known, VisitId now)> log_prior_same;
  /// Whether two visits may have been to one place, as far as is known of the way between them.
  /// Asked before places are looked for that no link leads to. Without it, they all are.
  std::function<bool(VisitId known, VisitId now)> is_within_reach;
  /// Log-likelihood of the displacements between visits under the best metrical layout of the map,
  /// over all its visits (Modayil et al., IROS 2004). It must not rise when a visit is added.
  std::function<double(const TopologicalMap&)> layout;
};

/// A kind of evidence that a configuration may name.
enum class EvidenceName {
  kPlaceMatch,  ///< "place_match": Evidence::same_place.
  kLayout,      ///< "layout": Evidence::layout.
};

/// Names separated by blanks, each at most once; "" is strict. An unknown name is an error that
/// lists the known ones.
[[nodiscard]] Result<std::vector<EvidenceName>> evidence_named(std::string_view names);

}  // namespace cairn
