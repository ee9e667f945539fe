#include "bench/lab/noise_command.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/lab/counts.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/search.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;

/// A way to explain what was seen, and what came of it.
struct Mode {
  std::string name;
  NoiseExperiment experiment;
  int worlds = 0;
  int true_best = 0;
  int among_first = 0;  ///< The true map is among the first 100 live hypotheses.
  int beaten = 0;       ///< The true map is less probable than the best one.
  double share = 0.0;   ///< Of the true map, summed.
  std::int64_t places_wrong = 0;
  std::int64_t places = 0;
  std::int64_t blamed = 0;
  std::int64_t misread = 0;
  EventCosts costs;
  std::vector<std::uint64_t> failed_seeds;
};

void count_in(const NoisyWorldResult& result, Mode* mode) {
  ++mode->worlds;
  mode->true_best += result.is_true_best ? 1 : 0;
  mode->among_first += result.rank ? 1 : 0;
  const bool is_beaten = !result.is_true_best && result.log_posterior_of_truth &&
                         *result.log_posterior_of_truth <= result.log_posterior;
  mode->beaten += is_beaten ? 1 : 0;
  mode->share += result.share;
  mode->places_wrong += result.places_wrong;
  mode->places += result.places;
  mode->blamed += result.contradictions;
  mode->misread += result.misread;
  const auto append = [](auto* all, const auto& some) {
    all->insert(all->end(), some.begin(), some.end());
  };
  append(&mode->costs.times_ms, result.costs.times_ms);
  append(&mode->costs.memory_bytes, result.costs.memory_bytes);
  if (!result.is_true_best) {
    mode->failed_seeds.push_back(result.seed);
  }
}

Json json_of(const Mode& mode) {
  return {{"mode", mode.name},
          {"worlds", mode.worlds},
          {"true_map_best", mode.true_best},
          {"true_map_among_first_100", mode.among_first},
          {"true_map_less_probable_than_best", mode.beaten},
          {"mean_share_of_true_map", mode.share / std::max(mode.worlds, 1)},
          {"places_wrong", mode.places_wrong},
          {"places", mode.places},
          {"contradictions_blamed", mode.blamed},
          {"visits_misread", mode.misread},
          {"event_ms_p50", mode.costs.time_ms(0.5)},
          {"event_ms_p99", mode.costs.time_ms(0.99)},
          {"event_ms_max", mode.costs.time_ms(1.0)},
          {"most_memory_bytes", mode.costs.most_memory_bytes()},
          {"failed_seeds", mode.failed_seeds}};
}

std::string percent(double part, double whole) {
  return fixed(100.0 * part / std::max(whole, 1.0), 1) + " %";
}

void print(const std::vector<Mode>& modes, std::ostream& out) {
  std::vector<std::string> headings{""};
  for (const Mode& mode : modes) {
    headings.push_back(mode.name);
  }
  clients::Table table(headings);
  const auto line = [&](const std::string& name, const auto& value) {
    std::vector<std::string> cells{name};
    for (const Mode& mode : modes) {
      cells.push_back(value(mode));
    }
    table.add(cells);
  };
  line("true map is best", [](const Mode& m) { return percent(m.true_best, m.worlds); });
  line("true map among the first 100",
       [](const Mode& m) { return percent(m.among_first, m.worlds); });
  line("true map is less probable than the best",
       [](const Mode& m) { return percent(m.beaten, m.worlds); });
  line("mean share of the true map", [](const Mode& m) { return percent(m.share, m.worlds); });
  line("places wrong",
       [](const Mode& m) { return grouped(m.places_wrong) + " of " + grouped(m.places); });
  line("observations blamed, misread",
       [](const Mode& m) { return grouped(m.blamed) + ", " + grouped(m.misread); });
  line("ms per arrival, median", [](const Mode& m) { return fixed(m.costs.time_ms(0.5), 2); });
  line("ms per arrival, 99 %", [](const Mode& m) { return fixed(m.costs.time_ms(0.99), 2); });
  line("ms per arrival, most", [](const Mode& m) { return fixed(m.costs.time_ms(1.0), 2); });
  line("most memory",
       [](const Mode& m) { return clients::byte_size(m.costs.most_memory_bytes()); });
  table.print(out);
}

/// The experiment with the match model that was asked for.
NoiseExperiment experiment_of(const NoiseRequest& request) {
  NoiseExperiment experiment = request.experiment;
  experiment.topology.noisy_stars = true;
  if (Status status = validate(experiment.noise); !status.ok()) {
    throw Failure(ExitCode::kUsage, status.error().message);
  }
  experiment.match.reset();
  if (request.match != "none") {
    MatchModel model;
    const std::string::size_type comma = request.match.find(',');
    try {
      std::size_t used = 0;
      model.mean = std::stod(request.match, &used);
      model.deviation = comma == std::string::npos ? std::sqrt(2.0 * model.mean)
                                                   : std::stod(request.match.substr(comma + 1));
    } catch (const std::exception&) {
      throw Failure(ExitCode::kUsage,
                    "--evidence: expected MEAN[,DEVIATION] or none, got \"" + request.match + "\"");
    }
    if (Status status = validate(model); !status.ok()) {
      throw Failure(ExitCode::kUsage, status.error().message);
    }
    experiment.match = model;
  }
  return experiment;
}

std::vector<Mode> modes_of(const NoiseRequest& request) {
  Mode noisy;
  noisy.name = "noisy stars";
  noisy.experiment = experiment_of(request);
  Mode strict = noisy;
  strict.name = "strict";
  strict.experiment.topology.noisy_stars = false;
  Mode symbols = strict;
  symbols.name = "strict, symbols only";
  symbols.experiment.match.reset();
  if (!noisy.experiment.match) {
    return {noisy, symbols};
  }
  return {noisy, strict, symbols};
}

Json json_of_tour(const NoisyWorldResult& result) {
  Json series = Json::array();
  constexpr std::size_t kParts = 20;
  const std::size_t events = result.costs.times_ms.size();
  for (std::size_t part = 0; part < std::min(kParts, events); ++part) {
    EventCosts some;
    const auto first = static_cast<std::ptrdiff_t>(part * events / kParts);
    const auto end = static_cast<std::ptrdiff_t>((part + 1) * events / kParts);
    some.times_ms.assign(result.costs.times_ms.begin() + first,
                         result.costs.times_ms.begin() + end);
    if (!some.times_ms.empty()) {
      series.push_back(
          {{"arrivals", end},
           {"event_ms_p50", some.time_ms(0.5)},
           {"event_ms_p99", some.time_ms(0.99)},
           {"memory_bytes", result.costs.memory_bytes[static_cast<std::size_t>(end) - 1]},
           {"waiting", result.costs.waiting[static_cast<std::size_t>(end) - 1]}});
    }
  }
  return {{"places_visited", result.places},
          {"travels", events},
          {"true_map_best", result.is_true_best},
          {"places_wrong", result.places_wrong},
          {"contradictions_blamed", result.contradictions},
          {"visits_misread", result.misread},
          {"event_ms_p50", result.costs.time_ms(0.5)},
          {"event_ms_p99", result.costs.time_ms(0.99)},
          {"event_ms_max", result.costs.time_ms(1.0)},
          {"most_memory_bytes", result.costs.most_memory_bytes()},
          {"peak_resident_bytes", peak_resident_bytes()},
          {"series", series}};
}

}  // namespace

void add_noise_options(CLI::App& command,
                       NoiseRequest* request,
                       CLI::Option* random,
                       CLI::Option* count) {
  CLI::Option* noise =
      command.add_flag("--noise", request->is_noise,
                       "Random worlds are seen badly: how often is the best map the true one");
  noise->needs(random);
  CLI::Option* tour = command.add_option("--tour", request->tour_places,
                                         "Walk through streets with about so many crossings");
  tour->type_name("PLACES")->check(CLI::Range(4, 100'000))->excludes(noise)->excludes(count);
  command.add_option("--travels", request->tour_travels, "Length of the tour")
      ->needs(tour)
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  NoiseExperiment& experiment = request->experiment;
  command.add_option("--steps", experiment.walk.travels, "Travels in each noisy world")
      ->needs(noise)
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  const auto probability = [&](const char* name, double* value, const char* help) {
    command.add_option(name, *value, help)->check(CLI::Range(0.0, 1.0))->capture_default_str();
  };
  probability("--misread", &experiment.noise.misread_probability,
              "Of taking a star for one of another kind");
  probability("--missed", &experiment.noise.missed_probability, "Of missing a gateway");
  probability("--false", &experiment.noise.false_probability,
              "Of seeing a gateway where there is none");
  command
      .add_option("--evidence", request->match,
                  "Log-likelihood ratios of matching local maps: mean and standard deviation "
                  "[calibrated]; none: symbols only")
      ->type_name("MEAN[,DEVIATION]|none")
      ->capture_default_str();
}

int explore_noisy_worlds(const NoiseRequest& request,
                         std::uint64_t first_seed,
                         int count,
                         bool as_json,
                         std::ostream& out) {
  std::vector<Mode> modes = modes_of(request);
  {
    clients::Progress progress("noisy worlds");
    for (int world = 0; world < count; ++world) {
      for (Mode& mode : modes) {
        count_in(run_noisy_world(mode.experiment, first_seed + static_cast<std::uint64_t>(world)),
                 &mode);
      }
      progress.show(world + 1, count);
    }
  }
  if (as_json) {
    Json json = {{"first_seed", first_seed}, {"count", count}, {"modes", Json::array()}};
    for (const Mode& mode : modes) {
      json["modes"].push_back(json_of(mode));
    }
    out << json.dump(2) << '\n';
  } else {
    out << count << " random worlds seen badly, seeds from " << first_seed << '\n';
    print(modes, out);
  }
  return 0;
}

int take_tour(const NoiseRequest& request, std::uint64_t seed, bool as_json, std::ostream& out) {
  NoiseExperiment experiment = experiment_of(request);
  experiment.walk.travels = request.tour_travels;
  if (experiment.match) {
    experiment.match->seed = seed;
  }
  // About one crossing in a hundred is cut off.
  constexpr double kClosedProbability = 0.12;
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(request.tour_places))));
  const World world = random_streets(side, side, kClosedProbability, seed);
  const Walk walk = with_noise(random_walk(world, experiment.walk, seed), experiment.noise, seed);
  const NoisyWorldResult result = run_noisy_walk(walk, experiment, seed);
  const Json json = json_of_tour(result);
  if (as_json) {
    out << json.dump(2) << '\n';
    return 0;
  }
  out << "A walk of " << request.tour_travels << " travels through " << world.places.size()
      << " places, of which " << result.places << " were visited\n";
  clients::Table table({"arrivals", "ms, median", "ms, 99 %", "memory", "waiting"});
  for (const Json& part : json["series"]) {
    table.add({grouped(part["arrivals"].get<std::int64_t>()), fixed(part["event_ms_p50"], 2),
               fixed(part["event_ms_p99"], 2), clients::byte_size(part["memory_bytes"]),
               grouped(part["waiting"].get<std::int64_t>())});
  }
  table.print(out);
  out << "All: median " << fixed(result.costs.time_ms(0.5), 2) << " ms, 99 % "
      << fixed(result.costs.time_ms(0.99), 2) << " ms, most " << fixed(result.costs.time_ms(1.0), 2)
      << " ms\n"
      << "The true map is " << (result.is_true_best ? "" : "not ") << "the best one; "
      << result.places_wrong << " of " << result.places << " places are wrong\n";
  return 0;
}

}  // namespace cairn::lab
