#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "topology/reading_match.hpp"
#include "topology/step.hpp"

namespace cairn {

/// Why some map that is consistent with the experience may no longer be among the hypotheses.
enum class GuaranteeLoss {
  kBudget,         ///< The memory was full (TopologyOptions::max_bytes).
  kContradiction,  ///< Every hypothesis was refuted; an observation had to be blamed.
  /// The same, but not all that might explain it was tried (TopologyOptions::max_repair_steps).
  kSearch,
};

/// At which visit the guarantee "every consistent map is among the live and waiting hypotheses" was
/// given up, and why.
struct GuaranteeGivenUp {
  VisitId visit;
  GuaranteeLoss loss = GuaranteeLoss::kBudget;
  /// Everything that was given up is less probable than this (natural logarithm, not normalised).
  double log_posterior_bound = std::numeric_limits<double>::infinity();
  std::string reason;  ///< One line for an operator.
};

/// An observation that a hypothesis takes to be wrong.
struct Blame {
  VisitId visit;
  StepKind kind = StepKind::kMisread;
  Misreading misreading = Misreading::kNone;
  double log_likelihood = 0.0;  ///< Of the step that blames it.
};

/// "visit 7: misread star; visit 9: break"
[[nodiscard]] std::string to_text(const std::vector<Blame>& blamed);

/// What was done when no hypothesis explained an arrival.
struct Repair {
  std::vector<Blame> blamed;  ///< By the best hypothesis found; the latest last.
  std::int64_t steps = 0;     ///< Of the search.
  /// Whether the least costly blame was found; if not, the arrival itself was left unexplained.
  bool is_explained = false;
  bool is_cut_short = false;  ///< Steps ran out with hypotheses left to try.
};

/// What one arrival did to the tree.
struct ExtendReport {
  VisitId visit;
  std::array<std::int64_t, kStepKinds> steps{};      ///< Consistent successors, by StepKind.
  std::array<std::int64_t, kRefutations> refuted{};  ///< Steps that were refuted, by Refutation.
  std::int64_t links_contradicted = 0;  ///< Of these, known links that disagree with the view.

  std::int64_t leaves = 0;    ///< Live hypotheses after this arrival.
  std::int64_t waiting = 0;   ///< Consistent ones that wait, as others are better.
  std::int64_t deferred = 0;  ///< That began to wait at this arrival.
  std::int64_t revived = 0;   ///< Steps of hypotheses that waited.
  std::int64_t layouts_evaluated = 0;
  std::int64_t layouts_deferred = 0;  ///< Leaves whose posterior is an upper bound only.

  std::int64_t breaks = 0;       ///< Leaves that go on although the visit contradicts them.
  std::optional<Repair> repair;  ///< No leaf explained the visit.
  std::int64_t dropped = 0;      ///< Given up for good.
  std::optional<GuaranteeGivenUp> guarantee_given_up;  ///< At this visit.
  /// All hypotheses, live and waiting, agree on everything up to this visit.
  VisitId settled_through;

  [[nodiscard]] std::int64_t count(StepKind kind) const {
    return steps[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] std::int64_t count(Refutation reason) const {
    return refuted[static_cast<std::size_t>(reason)];
  }
  /// All consistent successors.
  [[nodiscard]] std::int64_t nodes_added() const;
};

}  // namespace cairn
