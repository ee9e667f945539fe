#include "bench/lab/islands_command.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/islands_experiment.hpp"
#include "bench/lab/islands_picture.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

struct IslandsRequest {
  std::string world;
  std::string png_file;
  IslandsOptions options;
  bool as_json = false;
};

/// Poses whose distinctiveness lies in one of five parts of [0, 1].
struct Bin {
  std::size_t poses = 0;
  double mean_m = 0.0;
  double most_m = 0.0;
};

std::array<Bin, 5> bins_of(const IslandsRun& run) {
  std::array<Bin, 5> bins;
  for (const TriedPose& pose : run.poses) {
    const auto which = static_cast<std::size_t>(5.0 * pose.island.distinctiveness);
    Bin& bin = bins[std::min<std::size_t>(which, bins.size() - 1)];
    bin.most_m = std::max(bin.most_m, pose.error_m);
    bin.mean_m += (pose.error_m - bin.mean_m) / static_cast<double>(++bin.poses);
  }
  return bins;
}

OrderedJson json_of(const IslandsRun& run) {
  OrderedJson json = {{"poses", run.poses.size()},
                      {"rank_correlation", run.rank_correlation},
                      {"us_per_measure", run.us_per_measure},
                      {"tried", OrderedJson::array()}};
  for (const TriedPose& pose : run.poses) {
    json["tried"].push_back({{"x_m", pose.p_world.x()},
                             {"y_m", pose.p_world.y()},
                             {"distinctiveness", pose.island.distinctiveness},
                             {"dominating", pose.island.dominating},
                             {"weaker", pose.island.weaker},
                             {"heading", pose.island.heading},
                             {"quality", pose.island.quality},
                             {"error_m", pose.error_m},
                             {"error_rad", pose.error_rad}});
  }
  return json;
}

void print(const IslandsRun& run, std::ostream& out) {
  clients::Table table({"distinctiveness", "poses", "mean_error_m", "worst_m"});
  const std::array<Bin, 5> bins = bins_of(run);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double low = 0.2 * static_cast<double>(i);
    const bool is_empty = bins[i].poses == 0;
    table.add({fixed(low, 1) + " to " + fixed(low + 0.2, 1), std::to_string(bins[i].poses),
               is_empty ? "-" : fixed(bins[i].mean_m, 3),
               is_empty ? "-" : fixed(bins[i].most_m, 3)});
  }
  table.print(out);
  out << run.poses.size() << " poses; rank correlation of distinctiveness and error "
      << fixed(run.rank_correlation, 2) << "; " << fixed(run.us_per_measure, 0)
      << " us of CPU time per measure\n";
}

void check(const IslandsOptions& options) {
  const bool is_sound = options.spacing_m >= 0.1 && options.spacing_m <= 100.0 &&
                        options.starts >= 1 && options.starts <= 10'000 &&
                        options.offset_m >= 0.0 && options.offset_m <= 5.0;
  if (!is_sound) {
    throw Failure(ExitCode::kUsage,
                  "islands: expected --spacing in [0.1, 100], --starts in [1, 10000] and --offset "
                  "in [0, 5]");
  }
}

int explore(const IslandsRequest& request, const Streams& streams) {
  check_outputs({request.world}, {request.png_file});
  check(request.options);
  sim::World world;
  try {
    world = sim::read_world(request.world);
  } catch (const sim::BadWorld& bad) {
    throw Failure(ExitCode::kBadData, bad.what());
  }
  const IslandsRun run = run_islands(world, request.options);
  if (run.poses.empty()) {
    throw Failure(ExitCode::kBadData, request.world + ": no pose is far enough from walls");
  }
  if (request.as_json) {
    streams.out << json_of(run).dump(2) << '\n';
  } else {
    print(run, streams.out);
  }
  if (!request.png_file.empty()) {
    draw_islands(world, run, request.options, request.png_file);
  }
  return 0;
}

}  // namespace

void add_islands_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "islands", "Hold the distinctiveness of poses in a drawn world against the true error");
  auto request = std::make_shared<IslandsRequest>();
  command->add_option("WORLD", request->world, "Drawn world, as of cairn-sim")
      ->type_name("FILE")
      ->required();
  IslandsOptions& options = request->options;
  command->add_option("--spacing", options.spacing_m, "Of the grid of poses, m")
      ->capture_default_str();
  command->add_option("--starts", options.starts, "Perturbed starts from each pose")
      ->capture_default_str();
  command->add_option("--offset", options.offset_m, "Most offset of a start in x and y, m")
      ->capture_default_str();
  command->add_option("--seed", options.seed, "Same seed, same errors")->capture_default_str();
  command->add_option("--png", request->png_file, "Draw measure and error over the building")
      ->type_name("FILE");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = explore(*request, streams); });
}

}  // namespace cairn::lab
