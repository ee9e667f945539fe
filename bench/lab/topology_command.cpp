#include "bench/lab/topology_command.hpp"

#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

const std::vector<std::pair<std::string, SearchKind>> kKinds = {
    {"breadth", SearchKind::kBreadth},
    {"depth", SearchKind::kDepth},
    {"best", SearchKind::kBest},
};
const std::vector<std::pair<std::string, SearchOrder>> kOrders = {
    {"places", SearchOrder::kPlaces},
    {"paths", SearchOrder::kPaths},
    {"corners", SearchOrder::kCorners},
    {"paths-corners", SearchOrder::kPathsWithCorners},
};

/// One of a few names.
template <typename Value>
CLI::Option* add_choice(CLI::App& command,
                        const std::string& name,
                        const std::vector<std::pair<std::string, Value>>& choices,
                        Value* chosen,
                        const std::string& help) {
  std::string names;
  for (const auto& [choice, value] : choices) {
    names += names.empty() ? choice : "|" + choice;
  }
  const auto choose = [name, names, choices, chosen](const std::string& text) {
    for (const auto& [choice, value] : choices) {
      if (choice == text) {
        *chosen = value;
        return;
      }
    }
    throw CLI::ValidationError(name, "expected one of " + names + ", got " + text);
  };
  return command.add_option_function<std::string>(name, choose, help)->type_name(names);
}

/// CLI11 wraps what does not fit into 64 bits.
std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) {
    throw CLI::ValidationError("--random", "expected a seed from 0 to 18446744073709551615, got '" +
                                               clients::printable(text) + "'");
  }
  return seed;
}

/// Of a file that is read or written.
std::string empty_name(const std::string& name) {
  return name.empty() ? "expected the name of a file, got an empty one" : "";
}

/// Options that only make sense with --grid.
struct GridOptions {
  std::vector<CLI::Option*> options;
  CLI::Option* order = nullptr;
};

void add_sources(CLI::App& command, TopologyRequest* request, GridOptions* grid) {
  CLI::Option* on_grid =
      command.add_option("--grid", request->grid, "Explore a grid of streets")->type_name("RxC");
  CLI::Option* vectors =
      command
          .add_option("--vectors", request->vectors_file,
                      "Count every exploration of this file and compare with what it says")
          ->check(empty_name)
          ->type_name("FILE");
  CLI::Option* random =
      command
          .add_option_function<std::string>(
              "--random", [request](const std::string& text) { request->seed = seed_of(text); },
              "Explore random planar worlds, and compare with an obvious implementation")
          ->type_name("SEED");
  on_grid->excludes(vectors)->excludes(random);
  vectors->excludes(random);
  CLI::Option* count = command.add_option("--count", request->count, "Random worlds")
                           ->needs(random)
                           ->capture_default_str()
                           ->check(CLI::Range(1, 1'000'000));
  add_noise_options(command, &request->noise, random, count);
  grid->options = {
      command
          .add_option("--walk", request->walk, "The way [all rows to and fro, then all columns]")
          ->type_name("NESW..."),
      command.add_option("--start", request->start, "Place where the walk begins [0,0]")
          ->type_name("R,C")};
  for (CLI::Option* option : grid->options) {
    option->needs(on_grid);
  }
}

void add_search(CLI::App& command, TopologyRequest* request, GridOptions* grid) {
  ExactSearchOptions& search = request->search;
  command.add_flag("--planar", search.planar, "Links must lie within a face");
  add_choice(command, "--search", kKinds, &request->kind,
             "breadth: step by step, all leaves kept, as the daemon does it; depth: all maps, none "
             "kept; best: the most promising first, until a map is closed")
      ->default_str("depth");
  grid->order = add_choice(command, "--order", kOrders, &request->order,
                           "What best-first search takes for promising; those with corners need "
                           "--planar --perpendicular")
                    ->default_str("paths");
  command.add_flag("--region-axiom", search.region_consistent,
                   "Drop maps that are not region-consistent as soon as they are not");
  grid->options.insert(
      grid->options.end(),
      {grid->order,
       command.add_option("--max-places", search.max_places, "Drop maps of more places")
           ->check(CLI::Range(1, 1'000'000)),
       command.add_flag("--perpendicular", search.perpendicular,
                        "Drop maps where two paths meet twice or three form a triangle"),
       command.add_flag("--look-ahead", search.look_ahead,
                        "Skip maps that the rest of the walk cannot close"),
       command.add_flag("--look-ahead-by-face", search.look_ahead_by_face,
                        "Skip maps with a face that cannot be closed; with --planar --look-ahead"),
       command
           .add_option("--max-corners", search.max_corners,
                       "Skip maps that need more corners (L); with --planar --perpendicular")
           ->check(CLI::Range(0, 1'000'000)),
       command.add_flag("--straight", search.straight_corridors,
                        "Corridors are straight: a gateway is north-south or east-west"),
       command.add_flag("--compass", search.compass, "Corridors keep their heading"),
       command
           .add_option("--max-nodes", search.max_nodes,
                       "Give up a search that needs more nodes (breadth: in the travel that makes "
                       "them, which is then not counted) [no limit]")
           ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 60))});
}

void add_output(CLI::App& command, TopologyRequest* request, GridOptions* grid) {
  command.add_flag("--json", request->as_json, "Print JSON");
  const auto file = [&](const char* name, std::string* path, const char* help) {
    grid->options.push_back(
        command.add_option(name, *path, help)->check(empty_name)->type_name("FILE"));
  };
  file("--svg", &request->svg_file, "Draw the simplest map");
  file("--dot", &request->dot_file, "The simplest map for Graphviz");
  file("--graphml", &request->graphml_file, "The simplest map as GraphML");
  file("--tree-dot", &request->tree_dot_file, "A small tree of maps for Graphviz");
}

/// No file is written over by another one of the same run. Devices may be.
void check_files(const TopologyRequest& request) {
  std::map<std::filesystem::path, std::string> options;
  for (const auto& [option, file] : {std::pair("--svg", request.svg_file),
                                     {"--dot", request.dot_file},
                                     {"--graphml", request.graphml_file},
                                     {"--tree-dot", request.tree_dot_file}}) {
    std::error_code error;
    const bool is_device =
        std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error);
    if (file.empty() || is_device) {
      continue;
    }
    const auto [other, is_new] =
        options.emplace(std::filesystem::weakly_canonical(std::filesystem::absolute(file)), option);
    if (!is_new) {
      throw Failure(ExitCode::kUsage, std::string(option) + ": " + clients::printable(file) +
                                          " is the file of " + other->second + ", too");
    }
  }
}

/// What the searches cannot do, by the names of the options.
void check_search(const TopologyRequest& request) {
  const ExactSearchOptions& search = request.search;
  const bool is_perpendicular = search.planar && search.perpendicular;
  const bool counts_corners =
      request.order == SearchOrder::kCorners || request.order == SearchOrder::kPathsWithCorners;
  const auto refuse_if = [](bool is_wrong, const char* what) {
    if (is_wrong) {
      throw Failure(ExitCode::kUsage, what);
    }
  };
  refuse_if(counts_corners && !is_perpendicular,
            "--order: an order with corners needs --planar and --perpendicular");
  refuse_if(search.max_corners && !is_perpendicular,
            "--max-corners needs --planar and --perpendicular");
  refuse_if(search.look_ahead_by_face && !(search.planar && search.look_ahead),
            "--look-ahead-by-face needs --planar and --look-ahead");
  refuse_if(request.kind == SearchKind::kBreadth &&
                (search.perpendicular || search.look_ahead || search.max_corners ||
                 search.straight_corridors || search.compass),
            "--search breadth: the on-line tree cannot look ahead or assume headings or "
            "perpendicular streets; expected --search depth or best");
  if (!request.tree_dot_file.empty()) {
    refuse_if(request.kind == SearchKind::kBest,
              "--tree-dot draws whole trees, of which --search best grows a part only; expected "
              "--search depth or breadth");
    refuse_if(search.max_nodes > 0,
              "--tree-dot draws whole trees, of which --max-nodes leaves out a part");
    refuse_if(search.perpendicular || search.look_ahead || search.max_corners ||
                  search.straight_corridors || search.compass,
              "--tree-dot draws whole trees: of the options that drop maps, it knows --planar, "
              "--region-axiom and --max-places");
  }
}

/// Usage that CLI11 cannot express.
void check_use(const TopologyRequest& request, const GridOptions& grid) {
  const bool is_tour = request.noise.tour_places > 0;
  if (request.grid.empty() && request.vectors_file.empty() && !request.seed && !is_tour) {
    throw Failure(ExitCode::kUsage,
                  "topology: one of --grid, --vectors, --random and --tour is required");
  }
  for (const CLI::Option* option : grid.options) {
    if (request.grid.empty() && option->count() > 0) {
      throw Failure(ExitCode::kUsage, option->get_name() + " needs --grid");
    }
  }
  if (grid.order->count() > 0 && request.kind != SearchKind::kBest) {
    throw Failure(ExitCode::kUsage, "--order needs --search best");
  }
  check_search(request);
  check_files(request);
  if (request.seed && request.search.region_consistent) {
    throw Failure(ExitCode::kUsage, "--region-axiom needs --grid or --vectors");
  }
  if (request.grid.empty() && request.kind == SearchKind::kBest) {
    throw Failure(ExitCode::kUsage, "--search best needs --grid: it does not count all maps");
  }
  const std::uint64_t most_seed = std::numeric_limits<std::uint64_t>::max();
  if (request.seed && *request.seed > most_seed - static_cast<std::uint64_t>(request.count - 1)) {
    throw Failure(ExitCode::kUsage, "--random: with --count " + std::to_string(request.count) +
                                        " the last seed would not fit into 64 bits");
  }
  if (request.seed && request.search.planar) {
    throw Failure(ExitCode::kUsage, "--random looks at maps with and without planarity");
  }
}

}  // namespace

void add_topology_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "topology", "Count and search the maps that are consistent with an exploration");
  auto request = std::make_shared<TopologyRequest>();
  auto grid = std::make_shared<GridOptions>();
  add_sources(*command, request.get(), grid.get());
  add_search(*command, request.get(), grid.get());
  add_output(*command, request.get(), grid.get());
  command->callback([request, grid, &out = streams.out, status] {
    check_use(*request, *grid);
    if (request->noise.tour_places > 0) {
      *status = take_tour(request->noise, request->seed.value_or(1), request->as_json, out);
    } else if (request->noise.is_noise) {
      *status = explore_noisy_worlds(request->noise, *request->seed, request->count,
                                     request->as_json, out);
    } else if (request->seed) {
      *status = explore_random_worlds(*request, out);
    } else if (!request->vectors_file.empty()) {
      *status = explore_vectors(*request, out);
    } else {
      *status = explore_grid(*request, out);
    }
  });
}

}  // namespace cairn::lab
