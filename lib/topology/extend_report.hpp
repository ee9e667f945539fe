#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "topology/successors.hpp"

namespace cairn {

/// Why some map that is consistent with the experience may no longer be among the hypotheses.
enum class GuaranteeLoss {
  kBudget,         ///< More hypotheses than TopologyOptions::max_hypotheses.
  kContradiction,  ///< Every hypothesis was refuted; the best live on with an unexplained gateway.
};

/// At which visit the guarantee "every consistent map is among the leaves" was given up, and why.
struct GuaranteeGivenUp {
  VisitId visit;
  GuaranteeLoss loss = GuaranteeLoss::kBudget;
  std::string reason;  ///< One line for an operator.
};

/// What one arrival did to the tree.
struct ExtendReport {
  VisitId visit;
  std::int64_t nodes_added = 0;  ///< Consistent successors, those beyond the budget included.
  std::int64_t known_links = 0;  ///< Leaves whose known link agreed with the view.
  std::int64_t closures = 0;     ///< Consistent loop closures.
  std::int64_t new_places = 0;   ///< Leaves that grew by a place.
  std::int64_t misreadings = 0;  ///< Steps on which evidence overruled the star.
  std::int64_t rejoins = 0;      ///< Steps on which evidence overruled a link.
  std::int64_t links_contradicted = 0;  ///< Leaves whose known link disagrees with the view.

  // Closures that were refuted, by the first reason that applies.
  std::int64_t closures_of_other_view = 0;
  std::int64_t closures_of_other_face = 0;
  std::int64_t closures_repeating_a_place = 0;
  std::int64_t closures_against_regions = 0;
  std::int64_t refuted_by_evidence = 0;  ///< Known links included.
  std::int64_t beyond_place_bound = 0;   ///< New places that max_places forbids.

  std::int64_t leaves = 0;  ///< After this arrival.
  std::int64_t layouts_evaluated = 0;
  std::int64_t layouts_deferred = 0;  ///< Leaves whose posterior is an upper bound only.

  std::int64_t breaks = 0;        ///< Leaves that go on although the visit contradicts them.
  bool was_break_needed = false;  ///< No leaf explains the visit.
  std::int64_t dropped = 0;       ///< By the budget, or not among the best at a break.
  /// Posterior (before the layout) of the best that the budget dropped.
  double best_dropped_log_posterior = -std::numeric_limits<double>::infinity();
  std::optional<GuaranteeGivenUp> guarantee_given_up;  ///< At this visit.
};

/// Adds a refuted alternative to the report's counts.
void count_refuted(const Alternative& alternative, ExtendReport& report);
/// Adds a consistent successor.
void count_possible(StepKind kind, ExtendReport& report);

}  // namespace cairn
