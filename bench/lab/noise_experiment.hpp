#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/lab/worlds/noise.hpp"
#include "bench/lab/worlds/random_world.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn::lab {

/// Random worlds, seen badly.
struct NoiseExperiment {
  RandomWorldOptions world;
  RandomWalkOptions walk{100};
  NoiseOptions noise{0.05, 0.02, 0.0};
  /// How well local maps match, calibrated or not; none: symbols are all there is. Its seed is
  /// that of the world.
  std::optional<MatchModel> match = MatchModel{};
  TopologyOptions topology = with_independent_answers();

  /// The match model draws each ratio anew.
  [[nodiscard]] static TopologyOptions with_independent_answers() {
    TopologyOptions options;
    options.evidence_correlation = 0.0;
    return options;
  }
};

/// The walk of one seed, and how it was seen.
[[nodiscard]] Walk noisy_walk(const NoiseExperiment& experiment, std::uint64_t seed);

/// Asks the match model about this walk. @pre the walk outlives it
[[nodiscard]] Evidence evidence_of(const Walk& walk, const MatchModel& model);

/// What the arrivals of one walk cost.
struct EventCosts {
  std::vector<double> times_ms;            ///< By arrival.
  std::vector<std::int64_t> memory_bytes;  ///< Of the tree, after each arrival.
  std::vector<std::int64_t> waiting;       ///< Hypotheses.
  [[nodiscard]] double time_ms(double quantile) const;
  [[nodiscard]] std::int64_t most_memory_bytes() const;
};

/// Tells the tree the whole walk.
[[nodiscard]] HypothesisTree grown_tree(const Walk& walk,
                                        const TopologyOptions& options,
                                        const Evidence& evidence,
                                        EventCosts* costs);

/// Places of the walk that the map has wrong: their visits are not exactly the visits of one place
/// of the map; or the gateways by which the robot came and left are not told apart as they are; or
/// the map has fewer gateways there than were seen at all, or more (some visit may have seen one
/// that is not there, then more are allowed). How fragments join gateways is not compared.
[[nodiscard]] int places_wrong(const TopologicalMap& map, const Walk& walk);

/// What came of one world.
struct NoisyWorldResult {
  std::uint64_t seed = 0;
  int visits = 0;
  int places = 0;  ///< Visited.
  bool is_true_best = false;
  /// Of the true map among the live hypotheses, 0 is the best; none: not among the first 100.
  std::optional<int> rank;
  double share = 0.0;      ///< Of the live hypotheses' posterior, of the true map.
  int places_wrong = 0;    ///< In the best map.
  int contradictions = 0;  ///< Blamed by the best map.
  int misread = 0;         ///< Visits that were not seen as they are.
  bool is_guarantee_kept = true;
  double log_posterior = 0.0;  ///< Of the best map.
  /// Of the true map, as a tree finds it that is told the truth; none: that one does not find it
  /// either. Where it is less than that of the best map, no search could do better.
  std::optional<double> log_posterior_of_truth;
  EventCosts costs;
};

/// @pre the experiment's options are valid
[[nodiscard]] NoisyWorldResult run_noisy_world(const NoiseExperiment& experiment,
                                               std::uint64_t seed);
/// The same for any walk. @pre the walk outlives the call
[[nodiscard]] NoisyWorldResult run_noisy_walk(const Walk& walk,
                                              const NoiseExperiment& experiment,
                                              std::uint64_t seed);

}  // namespace cairn::lab
