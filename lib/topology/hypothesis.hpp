#pragma once

#include <string>

#include "topology/reading_match.hpp"
#include "topology/step.hpp"

namespace cairn {

/// A live hypothesis: a map that explains everything experienced so far.
struct Hypothesis {
  HypothesisId id;  ///< Stays while travels only follow known links: it names the map.
  HypothesisId parent;
  double log_steps = 0.0;   ///< Priors, evidence of same places, penalties.
  double log_layout = 0.0;  ///< Of the metrical layout; the parent's where deferred.
  int path_count = 0;
  int place_count = 0;
  int contradictions = 0;  ///< Observations that the map blames or fails to explain.
  bool is_layout_deferred = false;

  /// Natural logarithm, not normalised. An upper bound where the layout is deferred.
  [[nodiscard]] double log_posterior() const { return log_steps + log_layout; }
};

/// Where the robot is, said for sure.
struct PlaceClaim {
  VisitId first_visit;
  double log_odds = 0.0;
};

/// A node for those who draw the tree.
struct HypothesisNode {
  HypothesisId id;
  HypothesisId parent;
  VisitId visit;
  StepKind kind = StepKind::kStart;
  double log_likelihood = 0.0;
  bool is_live = false;
  bool is_waiting = false;
};

/// An alternative that a hypothesis had at a visit, and whether it took it.
struct Considered {
  StepKind kind = StepKind::kStart;
  Refutation refuted_by = Refutation::kNone;
  Misreading misreading = Misreading::kNone;
  GatewayRef departure;
  GatewayRef target;  ///< No place: a new one.
  double log_likelihood = 0.0;
  bool is_taken = false;
  std::string sentence;
};

/// Where two live hypotheses part, and what speaks for each since.
struct Parting {
  VisitId visit;          ///< At which they part.
  Considered of_a;        ///< What a took it for,
  Considered of_b;        ///< and b.
  double log_odds = 0.0;  ///< Of a against b, everything since counted.
  std::string sentence;
};

/// What becomes of a live hypothesis' map if a visit is taken for something else: the map that
/// was refuted, and by what.
struct Fate {
  bool is_refuted = false;
  VisitId visit;  ///< At which the first thing speaks against it, or the last one.
  Refutation reason = Refutation::kNone;
  double log_odds = 0.0;  ///< Against the live hypothesis; minus infinity if refuted.
  std::string sentence;
};

}  // namespace cairn
