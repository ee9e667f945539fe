#include <utility>

#include <cairn_lcm/grid_map_t.hpp>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/drawing.hpp"
#include "clients/cairn/perceived_visits.hpp"
#include "clients/cairn/topology_files.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

struct MapOptions {
  SourceOptions source;
  std::string png;
  std::string pgm;
  std::string svg;
  bool with_trajectory = false;
  bool with_places = false;
  int pixels = 1600;
};

struct ExportOptions {
  SourceOptions source;
  std::string trajectory;
  std::string covariances;
  std::string svg;
  std::string dot;
  std::string graphml;
};

void note(const Streams& streams, const std::string& path) {
  streams.err << "wrote " << path << '\n';
}

/// Whose map it is, where it is not taken for granted.
void note_hypothesis(const SourceOptions& options, MapSource& source, const Streams& streams) {
  if (options.hypothesis >= 0) {
    streams.err << "hypothesis " << options.hypothesis << ", probability "
                << fixed(source.topology().probability, 3) << '\n';
  }
}

void write_map(const MapOptions& options, const Streams& streams) {
  if (options.png.empty() && options.pgm.empty() && options.svg.empty()) {
    throw Failure(ExitCode::kUsage, "map: name at least one output: --png, --pgm or --svg");
  }
  for (const auto& [one, other] :
       {std::pair(&options.png, &options.pgm), std::pair(&options.png, &options.svg),
        std::pair(&options.pgm, &options.svg)}) {
    if (!one->empty() && *one == *other) {
      throw Failure(ExitCode::kUsage, "map: " + *one + " is to be written twice: choose two names");
    }
  }
  if (options.with_trajectory && options.png.empty()) {
    throw Failure(ExitCode::kUsage, "map: --trajectory is drawn into a picture: add --png FILE");
  }
  if (options.with_places && options.png.empty()) {
    throw Failure(ExitCode::kUsage, "map: --places are drawn into a picture: add --png FILE");
  }
  const std::unique_ptr<MapSource> source = open_source(options.source);
  note_hypothesis(options.source, *source, streams);
  MapLayers layers;
  if (!options.png.empty() || !options.pgm.empty()) {
    layers.grid = raster_of(source->global_map());
  }
  if (!options.png.empty() || !options.svg.empty()) {
    layers.topology = source->topology();
  }
  if (options.with_trajectory) {
    layers.trajectory = source->trajectory();
  }
  if (options.with_places) {
    layers.perceived = shown_visits(*source, *layers.topology);
  }
  if (!options.png.empty()) {
    write_png(draw_map(layers, options.pixels), options.png);
    note(streams, options.png);
  }
  if (!options.pgm.empty()) {
    note(streams, options.pgm + " and " + write_ros_map(*layers.grid, options.pgm).string());
  }
  if (!options.svg.empty()) {
    write_file(options.svg, topology_svg(*layers.topology));
    note(streams, options.svg);
  }
}

void write_exports(const ExportOptions& options, const Streams& streams) {
  const bool has_graph = !options.svg.empty() || !options.dot.empty() || !options.graphml.empty();
  if (options.trajectory.empty() && options.covariances.empty() && !has_graph) {
    throw Failure(ExitCode::kUsage,
                  "export: name at least one output: --trajectory, --covariances, --topology-svg, "
                  "--dot or --graphml");
  }
  const std::unique_ptr<MapSource> source = open_source(options.source);
  note_hypothesis(options.source, *source, streams);
  const auto write = [&](const std::string& path, const std::string& content) {
    write_file(path, content);
    note(streams, path);
  };
  if (!options.trajectory.empty()) {
    write(options.trajectory, trajectory_text(source->trajectory()));
  }
  if (!options.covariances.empty()) {
    write(options.covariances, covariances_text(source->trajectory()));
  }
  if (!has_graph) {
    return;
  }
  const cairn_lcm::topology_t topology = source->topology();
  if (!options.svg.empty()) {
    write(options.svg, topology_svg(topology));
  }
  if (!options.dot.empty()) {
    write(options.dot, topology_dot(topology));
  }
  if (!options.graphml.empty()) {
    write(options.graphml, topology_graphml(topology));
  }
}

}  // namespace

void add_map_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand("map", "Draws the map");
  const auto options = std::make_shared<MapOptions>();
  command->add_option("--png", options->png, "Picture of the map with places and paths");
  command->add_option("--pgm", options->pgm,
                      "Grid for the map_server of ROS; the .yaml file goes beside it");
  command->add_option("--svg", options->svg, "Drawing of the topological map");
  command->add_flag("--trajectory", options->with_trajectory,
                    "Show the robot's way in the picture");
  command->add_flag("--places", options->with_places,
                    "Show what was seen of each place: its axis, its paths, all openings");
  command->add_option("--pixels", options->pixels, "Longest side of the picture")
      ->capture_default_str()
      ->check(CLI::Range(64, 16384));
  add_map_file(*command, &options->source);
  add_hypothesis(*command, &options->source);
  add_link_options(*command, &options->source.link);
  command->callback([options, streams] { write_map(*options, streams); });
}

void add_export_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand("export", "Writes the map in formats of other programs");
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("--trajectory", options->trajectory,
                      "Lines `t x y theta` (s, m, rad) for every scan");
  command->add_option("--covariances", options->covariances,
                      "Lines `t xx xy yy x-theta y-theta theta-theta` for every key scan");
  command->add_option("--topology-svg", options->svg, "Drawing of the topological map");
  command->add_option("--dot", options->dot, "Topological map for Graphviz");
  command->add_option("--graphml", options->graphml, "Topological map as GraphML");
  add_map_file(*command, &options->source);
  add_hypothesis(*command, &options->source);
  add_link_options(*command, &options->source.link);
  command->callback([options, streams] { write_exports(*options, streams); });
}

}  // namespace cairn::clients
