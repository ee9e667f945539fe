#pragma once

#include <cstdint>
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
  bool planar = true;  ///< No path segment crosses another: corridors of one storey.
  /// Without planarity, of each link between two faces: each raises the genus by one. [0, 10000]
  double log_penalty_handle = 0.0;
  bool region_consistent = false;  ///< Every path must separate a left from a right.
  std::optional<int> max_places;   ///< Maps do not grow beyond; without a value, unbounded. >= 1

  /// Stars may be misread, gateways missed or imagined, places passed without notice, each at the
  /// penalties below. If not, as in the papers, a hypothesis that a view contradicts dies, and a
  /// repair search is made when all are dead.
  bool noisy_stars = false;
  /// Of each place beyond the first. Where stars may be misread and evidence is asked, each closure
  /// has the prior of one of all pending gateways. [-1000, 0]
  double log_prior_new_place = -1.0;
  // Minus the logarithm of how often it happens, and happens in this way rather than another: of
  // every 20 stars one is misread, and may be taken for several kinds; of every 50 one lacks one of
  // several gateways; fewer have one too many.
  double log_penalty_misread = 4.5;  ///< Of each star whose fragments were misread. [0, 10000]
  double log_penalty_missed_gateway = 5.0;  ///< Of each gateway overlooked. [0, 10000]
  double log_penalty_false_gateway = 6.5;   ///< Of each gateway seen that is not there. [0, 10000]
  double log_penalty_unnoticed = 10.0;      ///< Of each place passed without notice. [0, 10000]
  /// Of each junction that nobody noticed, where dead reckoning tells where the robot is
  /// (Evidence::log_prior_same). [0, 10000]
  double log_penalty_junction = 3.0;
  double log_penalty_break = 16.0;  ///< Of each observation left unexplained. [0, 10000]
  /// A closure against what was seen is considered if it is not less likely than a new place by
  /// more than this. [0, 10000]
  double blame_margin = 8.0;
  double recognition_threshold = 2.0;  ///< Evidence above it may overrule a link. [0, 10000]
  double max_log_evidence = 20.0;      ///< Each answer about same places is cut to it. [0, 1000]
  /// Of the visits to a place so many are compared with a new one, the last ones. [1, 1000]
  int max_visits_compared = 4;
  /// Between any two answers about one place: what one comparison gets wrong, another may get wrong
  /// for the same reason. 0: answers are independent; 1: one is worth as much as many. [0, 1]
  double evidence_correlation = 0.5;

  Preference preference = Preference::kPosterior;
  /// Live hypotheses: the best ones, judged before the new layouts are known. The others wait and
  /// are taken up again when they come to be among the best. [1, 10000000]
  int max_hypotheses = 64;
  /// Where more are good enough to live, so many that part from the best one at the same visit are
  /// preferred to those that part from it elsewhere: else old ambiguities, multiplied, would take
  /// all the room. [1, 10000000]
  int max_alike = 4;
  /// By posterior: a hypothesis that is less likely than the best live one by more than this waits.
  /// [0, 1e6]
  double live_margin = 30.0;
  /// Memory of nodes and leaves after each arrival: when it is full, the worse half of those that
  /// wait is given up, and again, then that of the live ones, and with them the guarantee.
  /// [65536, 1e12]
  std::int64_t max_bytes = 64 << 20;
  /// What one that waits is taken to lose per visit: alternatives to the last steps are tried
  /// before those to old ones. [0, 100]
  double log_loss_waiting = 0.2;
  int max_revivals = 100;          ///< Steps of waiting hypotheses per arrival. [0, 10000000]
  int max_repair_steps = 20000;    ///< Steps of one repair search. [0, 10000000]
  int max_broken_hypotheses = 32;  ///< How many survive an arrival nothing explains. [1, 10000000]
  double layout_margin = 50.0;     ///< Hypotheses further below the best are not laid out. [0, 1e6]
  /// A place is claimed after waking up once its odds against all others reach this. [1, 1e12]
  double claim_odds = 100.0;
};

/// Names every field that is out of range, with its value.
Status validate(const TopologyOptions& options);

/// How many independent answers so many are worth, any two of which have this correlation: that of
/// their mean is as sharp. @pre answers >= 1; correlation in [0, 1]
[[nodiscard]] double independent_answers(int answers, double correlation);
/// Of all the visits with which one is compared.
[[nodiscard]] double most_independent_answers(const TopologyOptions& options);

}  // namespace cairn
