#pragma once

#include <cstdint>

#include "topology/topology_options.hpp"
#include "topology/tree_nodes.hpp"

namespace cairn {

/// A map of the tree and the robot in it, after some visit: the last one, or, where it waits, an
/// earlier one. Where the best of its successors live on by themselves, it waits for the others.
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
  std::int32_t tried = 0;    ///< Successors at the next visit that left it, the best ones.
  std::int32_t untried = 0;  ///< Successors that wait in it; 0: it was not looked at.
  double log_untried = 0.0;  ///< The greatest log-likelihood of their steps.

  /// Maps that it stands for.
  [[nodiscard]] std::int64_t count() const { return untried > 0 ? untried : 1; }

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
