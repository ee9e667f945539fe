#include "clients/cairn/commands.hpp"
#include "clients/cairn/goal.hpp"
#include "clients/cairn/map_text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/map_file.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::result_t;

struct PathOptions {
  SourceOptions source;
  std::string goal;
  std::int64_t from_place = -1;
};

void refuse(const result_t& result) {
  const std::string reason = result.reason.empty() ? result.code_name : result.reason;
  const bool is_our_fault =
      result.code == result_t::NOT_FOUND || result.code == result_t::BAD_REQUEST;
  throw Failure(is_our_fault ? ExitCode::kBadData : ExitCode::kNoService,
                "no path: " + printable(reason));
}

void show_path(const PathOptions& options, const Streams& streams) {
  std::optional<cairn_lcm::plan_request_t> request = parse_goal(options.goal);
  if (!request) {
    throw Failure(ExitCode::kUsage, "path: --to takes a place, a name, or X,Y[,THETA_DEG]");
  }
  if (!options.source.map_file.empty()) {
    const MapFile file(options.source.map_file);  // Says first if it is no map at all.
    throw Failure(ExitCode::kNoService, "planning needs a running daemon: start `cairnd --map " +
                                            options.source.map_file +
                                            "` and ask again without the file");
  }
  request->from_place = options.from_place;
  const cairn_lcm::plan_t plan = DaemonLink(options.source.link).plan(*request);
  if (plan.result.code != result_t::OK) {
    refuse(plan.result);
  }
  if (options.source.as_json) {
    streams.out << dumped(to_json(plan)) << '\n';
  } else {
    print_plan(streams.out, plan);
  }
}

}  // namespace

void add_path_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand("path", "Asks the daemon for a way");
  const auto options = std::make_shared<PathOptions>();
  command
      ->add_option("--to", options->goal,
                   "Number of a place, its name, or X,Y[,THETA_DEG] in the global frame (m, deg)")
      ->required();
  command->add_option("--from", options->from_place, "Number of a place [where the robot is]")
      ->check(CLI::NonNegativeNumber);
  add_map_file(*command, &options->source);
  add_json_flag(*command, &options->source.as_json);
  add_link_options(*command, &options->source.link);
  command->callback([options, streams] { show_path(*options, streams); });
}

}  // namespace cairn::clients
