#pragma once

#include <cstdint>

#include "topology/topology_options.hpp"
#include "topology/tree_nodes.hpp"

namespace cairn {

/// A map of the tree and the robot in it, after some visit: the last one, or, where it waits, an
/// earlier one.
struct Leaf {
  NodeIndex node = kNoNode;
  GatewayIndex position = kNoGateway;  ///< The gateway by which the robot came in.
  VisitId visit;                       ///< What it explains so far.
  std::int32_t path_count = 0;
  std::int32_t place_count = 0;
  std::int32_t contradictions = 0;
  double log_steps = 0.0;
  double log_layout = 0.0;
  bool is_layout_deferred = false;
  /// Waits with one thing to try at its next visit: a new place. All else was tried.
  bool is_new_place_only = false;

  [[nodiscard]] double log_posterior() const { return log_steps + log_layout; }
};

/// What a preference compares; the older one decides between equals, so that the order is
/// reproducible.
struct Rank {
  double log_posterior = 0.0;
  std::int32_t contradictions = 0;
  std::int32_t path_count = 0;
  std::int32_t place_count = 0;
  std::int64_t age = 0;  ///< Greater is younger.
};
[[nodiscard]] bool comes_before(const Rank& a, const Rank& b, Preference preference);

}  // namespace cairn
