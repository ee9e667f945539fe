#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "bench/lab/noise_experiment.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cairn::lab {

/// What `cairn-lab topology --noise` and `--tour` were asked for.
struct NoiseRequest {
  bool is_noise = false;
  int tour_places = 0;  ///< 0: no tour.
  int tour_travels = 5000;
  NoiseExperiment experiment;
  std::string match = "4,2.83";  ///< Mean and deviation; "none".
};

/// @param random, count the options of the command that say which worlds
void add_noise_options(CLI::App& command,
                       NoiseRequest* request,
                       CLI::Option* random,
                       CLI::Option* count);

/// Random worlds seen badly, `count` of them: how often the best map is the true one; with stars
/// that may be misread, without, and without evidence. Returns 0.
int explore_noisy_worlds(const NoiseRequest& request,
                         std::uint64_t first_seed,
                         int count,
                         bool as_json,
                         std::ostream& out);

/// One long walk through many streets: what each arrival costs. Returns 0.
int take_tour(const NoiseRequest& request, std::uint64_t seed, bool as_json, std::ostream& out);

}  // namespace cairn::lab
