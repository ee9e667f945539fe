#pragma once

#include <functional>

#include "topology/topological_map.hpp"

namespace cairn {

/// What the world outside of symbols says about a hypothesis. Functions that are not given say
/// nothing (0). They must be pure: same arguments, same result. A NaN is a broken precondition;
/// minus infinity refutes. Natural logarithms.
struct Evidence {
  /// Log-likelihood ratio of the new visit being at a known place rather than anywhere else, its
  /// gateway j being gateway (j + shift) mod n of the place; for example how well the LPMs match.
  /// Asked for every closure and known link that the symbols allow, and for places that a misread
  /// star or a wrong link may hide; for every hypothesis anew. So keep the answers by visit,
  /// before.first_visit(same_as) and shift. `before` does not hold the visit yet.
  std::function<double(const TopologicalMap& before, VisitId visit, PlaceId same_as, int shift)>
      same_place;
  /// Log-likelihood of the displacements between visits under the best metrical layout of the map,
  /// over all its visits (Modayil et al., IROS 2004). It must not rise when a visit is added.
  std::function<double(const TopologicalMap&)> layout;
};

}  // namespace cairn
