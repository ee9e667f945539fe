#pragma once

#include <optional>

#include "base/result.hpp"

namespace cairn {

/// Which hypothesis is the best one.
enum class Preference {
  /// Fewest contradictions, then paths, then places, then highest posterior: the prioritized
  /// circumscription of Kuipers et al., ICRA 2004, with its step 4 (matching LPMs, global layout)
  /// among the simplest. For experience without misread stars.
  kSimplest,
  kPosterior,  ///< Highest posterior, then fewest paths, then fewest places.
};

/// What the search for topological maps assumes and how much it may keep. In the configuration
/// file: the object "topology". Probabilities are natural logarithms (nats).
struct TopologyOptions {
  bool planar = true;              ///< No path segment crosses another: corridors of one storey.
  bool region_consistent = false;  ///< Every path must separate a left from a right.
  std::optional<int> max_places;   ///< Maps do not grow beyond; without a value, unbounded. >= 1
  /// Live hypotheses kept: the best ones, judged before the new layouts are known. [1, 10000000]
  int max_hypotheses = 2000;
  int max_broken_hypotheses = 32;  ///< Of these, how many survive a contradiction. [1, 10000000]
  /// With evidence of same places, every hypothesis that a visit contradicts lives on with an
  /// unexplained gateway, at log_penalty_break: stars are misread now and then, and what follows
  /// may prove the hypothesis right. If not, or without such evidence, a contradicted hypothesis
  /// dies, except that the best live on when all are contradicted.
  bool keep_contradicted = true;
  Preference preference = Preference::kPosterior;
  double log_prior_new_place = -1.0;   ///< Of each place beyond the first. [-1000, 0]
  double log_penalty_break = 10.0;     ///< Of each observation left unexplained. [0, 10000]
  double log_penalty_misread = 10.0;   ///< Of each star taken to be misread. [0, 10000]
  double recognition_threshold = 2.0;  ///< Evidence above it may overrule star or link. [0, 10000]
  double layout_margin = 50.0;  ///< Hypotheses further below the best are not laid out. [0, 1e6]
};

/// Names every field that is out of range, with its value.
Status validate(const TopologyOptions& options);

}  // namespace cairn
