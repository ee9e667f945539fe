// Beyond the papers: random worlds in which every twentieth star is misread and every fiftieth
// lacks a gateway, and matching local maps alone is wrong in 8 of 100 cases. cairn-lab topology
// --noise runs more of them.

#include <gtest/gtest.h>

#include "bench/lab/noise_experiment.hpp"

namespace cairn::lab {
namespace {

int worlds_with_true_map_best(const NoiseExperiment& experiment, std::uint64_t first, int count) {
  int best = 0;
  for (int world = 0; world < count; ++world) {
    best += run_noisy_world(experiment, first + static_cast<std::uint64_t>(world)).is_true_best;
  }
  return best;
}

NoiseExperiment small_experiment() {
  NoiseExperiment experiment;
  experiment.walk.travels = 60;
  experiment.topology.noisy_stars = true;
  experiment.topology.max_hypotheses = 100;
  return experiment;
}

TEST(NoisyWorlds, TrueMapIsBestInNinetyFiveOfAHundred) {
  EXPECT_GE(worlds_with_true_map_best(small_experiment(), 1, 100), 95);
}

TEST(NoisyWorlds, StrictModeFindsFewTrueMaps) {
  NoiseExperiment strict = small_experiment();
  strict.topology.noisy_stars = false;
  strict.topology.max_repair_steps = 2000;
  EXPECT_LE(worlds_with_true_map_best(strict, 1, 10), 5);
}

TEST(NoisyWorlds, WithoutNoiseTheTrueMapIsBest) {
  NoiseExperiment clear = small_experiment();
  clear.noise = {0.0, 0.0, 0.0};
  EXPECT_GE(worlds_with_true_map_best(clear, 1, 10), 9);
}

TEST(NoisyWorlds, SameSeedGivesTheSameMaps) {
  const NoiseExperiment experiment = small_experiment();
  const NoisyWorldResult once = run_noisy_world(experiment, 7);
  const NoisyWorldResult again = run_noisy_world(experiment, 7);
  EXPECT_EQ(once.log_posterior, again.log_posterior);
  EXPECT_EQ(once.costs.waiting, again.costs.waiting);
}

}  // namespace
}  // namespace cairn::lab
