#include "bench/lab/rooms_command.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/rooms_picture.hpp"
#include "bench/lab/rooms_score.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"
#include "grid/medial_axis.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

/// What came out for one map.
struct RoomsRun {
  std::string map;
  RegionGraph graph;
  double time_ms = 0.0;
  double skeleton_ms =
      0.0;  ///< Distance transform and medial axis of the piece of the largest region.
  std::optional<RoomsScore> score;
};

struct RoomsMeans {
  double recall = 0.0;
  double credited_recall = 0.0;
  double precision = 0.0;
  double regions = 0.0;
  double time_ms = 0.0;
};

void check(const RoomsRequest& request) {
  if (!request.truths.empty() && request.truths.size() != request.maps.size()) {
    throw Failure(ExitCode::kUsage, "--truth: expected one for every map, in the same order");
  }
  check_outputs(request.maps, {request.png_file});
  check_outputs(request.truths, {request.png_file});
  if (!request.png_file.empty() && request.maps.size() != 1) {
    throw Failure(ExitCode::kUsage, "--png: draws one map, not several");
  }
  if (const Status status = validate(request.options); !status) {
    throw Failure(ExitCode::kUsage, status.error().message);
  }
}

double ms_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

/// How long the Voronoi diagram around the largest region takes.
double time_skeleton_ms(const OccupancyGrid& grid, const RegionGraph& graph) {
  const auto largest =
      std::max_element(graph.regions.begin(), graph.regions.end(),
                       [](const Region& a, const Region& b) { return a.area_m2 < b.area_m2; });
  if (largest == graph.regions.end()) {
    return 0.0;
  }
  const auto begin = std::chrono::steady_clock::now();
  const MedialAxis axis =
      medial_axis(distance_transform(grid), largest->centre, MedialAxisOptions{});
  return axis.nodes.empty() ? 0.0 : ms_since(begin);
}

RoomsRun run_one(const RoomsRequest& request, std::size_t which) {
  RoomsRun run;
  run.map = request.maps[which];
  const OccupancyGrid grid = grid_of(read_grey_picture(run.map), request.cell_m);
  const auto begin = std::chrono::steady_clock::now();
  run.graph = region_graph(grid, request.options);
  run.time_ms = ms_since(begin);
  run.skeleton_ms = time_skeleton_ms(grid, run.graph);
  if (!request.truths.empty()) {
    const std::string& file = request.truths[which];
    const TrueRooms truth = true_rooms(read_grey_picture(file));
    if (truth.width != grid.geometry().width || truth.height != grid.geometry().height) {
      throw Failure(ExitCode::kBadData, file + ": expected a picture as large as the map, " +
                                            std::to_string(grid.geometry().width) + " x " +
                                            std::to_string(grid.geometry().height));
    }
    if (truth.cells.empty()) {
      throw Failure(ExitCode::kBadData, file + ": expected white rooms, found none");
    }
    run.score = score_of(run.graph, truth);
  }
  if (!request.png_file.empty()) {
    draw_regions(grid, run.graph, request.png_file);
  }
  return run;
}

RoomsMeans means_of(const std::vector<RoomsRun>& runs) {
  RoomsMeans means;
  const double share = 1.0 / static_cast<double>(runs.size());
  for (const RoomsRun& run : runs) {
    const RoomsScore score = run.score.value_or(RoomsScore{});
    means.recall += share * score.recall;
    means.credited_recall += share * score.credited_recall;
    means.precision += share * score.precision;
    means.regions += share * static_cast<double>(run.graph.regions.size());
    means.time_ms += share * run.time_ms;
  }
  return means;
}

OrderedJson json_of(const GridGeometry& geometry, Cell cell) {
  const Vector2d p = geometry.center_of(cell);
  return {p.x(), p.y()};
}

OrderedJson json_of(const RegionGraph& graph) {
  OrderedJson json = {{"regions", OrderedJson::array()}, {"critical_lines", OrderedJson::array()}};
  for (const Region& region : graph.regions) {
    json["regions"].push_back({{"centre_m", json_of(graph.geometry, region.centre)},
                               {"clearance_m", region.clearance_m},
                               {"area_m2", region.area_m2},
                               {"critical_lines", region.lines}});
  }
  for (const CriticalLine& line : graph.lines) {
    json["critical_lines"].push_back(
        {{"from", line.from},
         {"to", line.to},
         {"width_m", line.width_m},
         {"critical_point_m", json_of(graph.geometry, line.critical_point)},
         {"basis_points_m",
          {json_of(graph.geometry, line.basis_points[0]),
           json_of(graph.geometry, line.basis_points[1])}}});
  }
  return json;
}

OrderedJson json_of(const RoomsRun& run) {
  OrderedJson json = {{"map", run.map}};
  if (run.score) {
    json["recall"] = run.score->recall;
    json["credited_recall"] = run.score->credited_recall;
    json["precision"] = run.score->precision;
    json["rooms"] = run.score->rooms;
  }
  json["regions"] = run.graph.regions.size();
  json["critical_lines"] = run.graph.lines.size();
  json["time_ms"] = run.time_ms;
  json["skeleton_ms"] = run.skeleton_ms;
  json["graph"] = json_of(run.graph);
  return json;
}

OrderedJson json_of(const std::vector<RoomsRun>& runs) {
  if (runs.size() == 1) {
    return json_of(runs.front());
  }
  OrderedJson json = {{"maps", OrderedJson::array()}};
  for (const RoomsRun& run : runs) {
    json["maps"].push_back(json_of(run));
  }
  const RoomsMeans means = means_of(runs);
  if (runs.front().score) {
    json["recall"] = means.recall;
    json["credited_recall"] = means.credited_recall;
    json["precision"] = means.precision;
  }
  json["regions"] = means.regions;
  json["time_ms"] = means.time_ms;
  return json;
}

void print(const std::vector<RoomsRun>& runs, std::ostream& out) {
  const bool is_judged = runs.front().score.has_value();
  std::vector<std::string> headings{"map", "regions", "lines", "ms"};
  if (is_judged) {
    headings.insert(headings.end(), {"rooms", "recall %", "credited %", "precision %"});
  }
  clients::Table table(headings);
  for (const RoomsRun& run : runs) {
    std::vector<std::string> row{std::filesystem::path(run.map).filename().string(),
                                 std::to_string(run.graph.regions.size()),
                                 std::to_string(run.graph.lines.size()), fixed(run.time_ms, 1)};
    if (run.score) {
      row.insert(row.end(), {std::to_string(run.score->rooms), fixed(run.score->recall, 1),
                             fixed(run.score->credited_recall, 1), fixed(run.score->precision, 1)});
    }
    table.add(row);
  }
  if (runs.size() > 1) {
    const RoomsMeans means = means_of(runs);
    std::vector<std::string> row{"mean", fixed(means.regions, 1), "", fixed(means.time_ms, 1)};
    if (is_judged) {
      row.insert(row.end(), {"", fixed(means.recall, 1), fixed(means.credited_recall, 1),
                             fixed(means.precision, 1)});
    }
    table.add(row);
  }
  table.print(out);
}

int segment(const RoomsRequest& request, const Streams& streams) {
  check(request);
  std::vector<RoomsRun> runs;
  for (std::size_t i = 0; i < request.maps.size(); ++i) {
    runs.push_back(run_one(request, i));
  }
  if (request.as_json) {
    streams.out << json_of(runs).dump(2) << '\n';
  } else {
    print(runs, streams.out);
  }
  return 0;
}

}  // namespace

void add_rooms_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "rooms",
      "Regions and critical lines of floor plans: recall and precision against true rooms");
  auto request = std::make_shared<RoomsRequest>();
  command->add_option("MAP", request->maps, "Floor plans, PNG or PGM: white is free")
      ->type_name("FILE")
      ->required();
  command->add_option("--truth", request->truths, "Rooms as white areas; one for every map")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--png", request->png_file, "Draw the regions and critical lines")
      ->type_name("FILE");
  const auto number = [&](const char* name, double* value, const char* unit, const char* help) {
    command->add_option(name, *value, help)->type_name(unit)->capture_default_str();
  };
  command->add_option("--cell", request->cell_m, "Side of a pixel")
      ->type_name("M")
      ->check(clients::within(0.001, 10.0))
      ->capture_default_str();
  number("--max-line", &request->options.max_line_m, "M", "A wider opening parts no regions");
  number("--max-narrowing", &request->options.max_narrowing, "SHARE",
         "Clearance at a line over that of either side, at most");
  number("--widening", &request->options.widening, "SHARE",
         "Free space beyond a doorway is wider by this");
  number("--doorway-depth", &request->options.doorway_depth_m, "M",
         "How near beyond a doorway free space must be wider");
  number("--min-area", &request->options.min_area_m2, "M2", "Smaller regions join a neighbour");
  number("--furniture", &request->options.furniture_size_m, "M",
         "What stands free and is no longer than this is looked through");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = segment(*request, streams); });
}

}  // namespace cairn::lab
