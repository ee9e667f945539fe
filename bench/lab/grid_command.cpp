#include <algorithm>
#include <charconv>
#include <ostream>
#include <utility>

#include "bench/lab/counts.hpp"
#include "bench/lab/map_files.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "bench/lab/topology_command.hpp"
#include "bench/lab/tree_nodes.hpp"
#include "bench/lab/worlds/world.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

constexpr int kMostRows = 100;
constexpr std::size_t kMostDrawnPlaces = 1000;

/// Two numbers with a sign between them, "3x4".
std::pair<int, int> two_numbers(const std::string& option,
                                const std::string& text,
                                char separator,
                                std::pair<int, int> range) {
  const auto fail = [&] {
    throw Failure(ExitCode::kUsage, option + ": expected two numbers from " +
                                        std::to_string(range.first) + " to " +
                                        std::to_string(range.second) + " with '" + separator +
                                        "' between them, got '" + clients::printable(text) + "'");
  };
  const auto number = [&](const char* begin, const char* end) {
    int value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (begin == end || stop != end || error != std::errc() || value < range.first ||
        value > range.second) {
      fail();
    }
    return value;
  };
  const std::size_t middle = text.find(separator);
  if (middle == std::string::npos) {
    fail();
  }
  const char* begin = text.data();
  return {number(begin, begin + middle), number(begin + middle + 1, begin + text.size())};
}

/// A complaint about a search, its fields by the names of their options.
std::string as_options(std::string complaint) {
  const std::string object = "exact search.";
  for (std::size_t at = complaint.find(object); at != std::string::npos;
       at = complaint.find(object, at)) {
    complaint.replace(at, object.size(), "--");
  }
  std::replace(complaint.begin(), complaint.end(), '_', '-');
  return complaint;
}

/// What is explored.
struct GridExploration {
  int rows = 0;
  int columns = 0;
  std::string moves;
  Walk walk;
};

GridExploration exploration_of(const TopologyRequest& request) {
  const auto [rows, columns] = two_numbers("--grid", request.grid, 'x', {1, kMostRows});
  if (rows * columns < 2) {
    throw Failure(ExitCode::kUsage, "--grid: expected two places or more, got " + request.grid);
  }
  const GridWorld grid = grid_world(rows, columns);
  int start = 0;
  if (!request.start.empty()) {
    const auto [row, column] = two_numbers("--start", request.start, ',', {0, kMostRows - 1});
    if (row >= rows || column >= columns) {
      throw Failure(ExitCode::kUsage, "--start: row " + std::to_string(row) + ", column " +
                                          std::to_string(column) + " is not in a grid of " +
                                          request.grid);
    }
    start = row * columns + column;
  }
  const std::string moves = request.walk.empty() ? snake_moves(rows, columns) : request.walk;
  Result<Walk> walk = walk_grid(grid, start, moves);
  if (!walk) {
    throw Failure(ExitCode::kUsage, "--walk: " + clients::printable(walk.error().message));
  }
  return {rows, columns, moves, std::move(*walk)};
}

std::string name_of(SearchKind kind) {
  switch (kind) {
    case SearchKind::kBreadth:
      return "breadth";
    case SearchKind::kDepth:
      return "depth";
    case SearchKind::kBest:
      break;
  }
  return "best";
}

/// "3x3 grid, 16 travels, planar".
std::string title_of(const TopologyRequest& request, const GridExploration& grid) {
  const ExactSearchOptions& search = request.search;
  std::string title = request.grid + " grid, " +
                      std::to_string(grid.walk.exploration.steps.size()) + " travels, " +
                      (search.planar ? "planar" : "not planar");
  title += search.max_places ? ", at most " + std::to_string(*search.max_places) + " places" : "";
  title += search.region_consistent ? ", region-consistent" : "";
  title += search.perpendicular ? ", perpendicular" : "";
  title += search.look_ahead ? ", look-ahead" : "";
  title +=
      search.max_corners ? ", at most " + std::to_string(*search.max_corners) + " corners" : "";
  title += search.straight_corridors ? ", straight corridors" : "";
  return title + (search.compass ? ", compass" : "");
}

Json json_of(const TopologyRequest& request, const GridExploration& grid, const SearchRun& run) {
  Json json = {{"grid", request.grid},
               {"title", title_of(request, grid)},
               {"moves", grid.moves},
               {"mode", request.search.planar ? "planar" : "nonplanar"},
               {"search", name_of(request.kind)},
               {"minimised", minimised(request.kind, request.search, request.order)}};
  if (run.is_best_first) {
    json["tree_nodes"] = run.counts.tree_nodes;
    json["maps_built"] = run.counts.maps_built;
    json["best"] = nullptr;
    if (run.counts.optimal) {
      json["best"] = {{"paths", run.counts.optimal->paths},
                      {"places", run.counts.optimal->places},
                      {"is_proven", run.is_proven},
                      {"code", run.best_code}};
    }
    json["max_open"] = run.max_open;
  } else {
    json.update(to_json(run.counts));
  }
  json["is_complete"] = run.given_up.empty();
  json.update(cost_json(run));
  return json;
}

/// Codes of large maps fill screens.
std::string shortened(const std::string& code) {
  constexpr std::size_t kMost = 160;
  return code.size() <= kMost ? code : code.substr(0, kMost) + "... (all of it with --json)";
}

void print_best(const TopologyRequest& request, const SearchRun& run, std::ostream& out) {
  if (!run.counts.optimal) {
    out << "  no map without pending gateways was found\n";
  } else {
    out << "  first closed map: " << run.counts.optimal->paths << " paths, "
        << run.counts.optimal->places << " places; "
        << (run.is_proven ? "none is better" : "a better one is not excluded") << "\n  "
        << shortened(run.best_code) << '\n';
  }
  out << "  minimised: " << minimised(request.kind, request.search, request.order) << "\n  "
      << grouped(run.counts.tree_nodes) << " nodes made, " << grouped(run.counts.maps_built)
      << " maps built, at most " << grouped(run.max_open) << " waiting\n";
}

void print(const TopologyRequest& request,
           const GridExploration& grid,
           const SearchRun& run,
           std::ostream& out) {
  out << title_of(request, grid) << ": " << grid.moves << '\n';
  if (run.is_best_first) {
    print_best(request, run, out);
  } else {
    print_counts(run.counts, out);
  }
  if (!run.given_up.empty()) {
    out << "  " << run.given_up << '\n';
  }
  out << "  " << cost_text(run) << '\n';
}

/// The map that is drawn: the simplest closed one, or else the simplest one that is not folded.
DrawnMap simplest_map(const TopologyRequest& request,
                      const GridExploration& grid,
                      const SearchRun& run) {
  const std::string title = title_of(request, grid) + ": ";
  const Exploration& exploration = grid.walk.exploration;
  if (run.counts.optimal && !run.counts.optimal->codes.empty()) {
    const std::int64_t count = run.counts.optimal->count;
    const std::string which = count == 1 ? "the simplest closed map"
                                         : "one of the " + grouped(count) + " simplest closed maps";
    return drawn_map(run.counts.optimal->codes.front(), exploration,
                     title + (run.is_best_first ? "the closed map found first" : which));
  }
  if (run.is_best_first) {
    throw Failure(ExitCode::kBadData, "no map to draw: none that is closed was found");
  }
  // Of unfinished walks the simplest maps of all explain much by few places in a triangle.
  ExactSearchOptions options = request.search;
  options.perpendicular = true;
  const MapCounts counts = enumerate(exploration, options).counts;
  if (!counts.minimal_region || counts.minimal_region->codes.empty()) {
    throw Failure(ExitCode::kBadData,
                  "no map to draw: there is none that is closed or perpendicular");
  }
  return drawn_map(counts.minimal_region->codes.front(), exploration,
                   title + "a simplest perpendicular map; none is closed");
}

void write_map(const TopologyRequest& request, const GridExploration& grid, const SearchRun& run) {
  if (request.svg_file.empty() && request.dot_file.empty() && request.graphml_file.empty()) {
    return;
  }
  const DrawnMap map = simplest_map(request, grid, run);
  if (map.places.size() > kMostDrawnPlaces) {
    throw Failure(ExitCode::kBadData, "a map of " + std::to_string(map.places.size()) +
                                          " places is too large for a picture (at most " +
                                          std::to_string(kMostDrawnPlaces) + ")");
  }
  if (!request.svg_file.empty()) {
    clients::write_file(request.svg_file, map_svg(map));
  }
  if (!request.dot_file.empty()) {
    clients::write_file(request.dot_file, map_dot(map));
  }
  if (!request.graphml_file.empty()) {
    clients::write_file(request.graphml_file, map_graphml(map));
  }
}

void write_tree(const TopologyRequest& request, const GridExploration& grid) {
  if (request.tree_dot_file.empty()) {
    return;
  }
  ExactSearchOptions bounded = request.search;
  bounded.max_nodes = kMostDrawnNodes;
  if (!enumerate(grid.walk.exploration, bounded).is_complete) {
    throw Failure(ExitCode::kBadData, "--tree-dot: the tree has more than " +
                                          grouped(kMostDrawnNodes) +
                                          " nodes, too many for a picture; shorten the walk");
  }
  const std::vector<TreeNode> nodes = nodes_of_tree(grid.walk.exploration, request.search);
  clients::write_file(request.tree_dot_file, tree_dot(nodes, title_of(request, grid)));
}

}  // namespace

int explore_grid(const TopologyRequest& request, std::ostream& out) {
  const GridExploration grid = exploration_of(request);
  ExactSearchOptions options = request.search;
  // All that there are, since one of them may be drawn.
  options.max_codes = 100'000;
  const Status status = request.kind == SearchKind::kBest
                            ? validate(options, grid.walk.exploration, request.order)
                            : validate(options, grid.walk.exploration);
  if (!status) {
    throw Failure(ExitCode::kUsage, as_options(status.error().message));
  }
  write_tree(request, grid);
  SearchRun run;
  {
    const Elapsed elapsed("exploring");
    run = run_search(request.kind, grid.walk.exploration, options, request.order);
  }
  write_map(request, grid, run);
  if (request.as_json) {
    out << json_of(request, grid, run).dump(2) << '\n';
  } else {
    print(request, grid, run, out);
  }
  return 0;
}

}  // namespace cairn::lab
