#include <filesystem>

#include "clients/cairn/commands.hpp"
#include "clients/cairn/map_text.hpp"
#include "clients/cairn/perceived_visits.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/place_picture.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using Json = nlohmann::ordered_json;
using cairn_lcm::perceived_place_t;

struct PlacesOptions {
  SourceOptions source;
  std::string png_folder;
  bool with_all_visits = false;
};

std::string name_of(const cairn_lcm::topology_t& topology, std::int64_t id) {
  for (const cairn_lcm::place_t& place : topology.places) {
    if (place.id == id) {
      return place.name;
    }
  }
  return "";
}

std::string file_name(const perceived_place_t& seen, bool with_all_visits) {
  const std::string place =
      seen.place_id < 0 ? "no-place" : "place-" + std::to_string(seen.place_id);
  return place + (with_all_visits ? "-visit-" + std::to_string(seen.visit) : "") + ".png";
}

/// @return what was written
Json draw_pictures(const PlacesOptions& options,
                   const cairn_lcm::topology_t& topology,
                   MapSource& source,
                   const Streams& streams) {
  if (topology.places.empty()) {
    throw Failure(ExitCode::kBadData,
                  "places: the map has no places yet, so there is none to draw");
  }
  const std::filesystem::path folder = options.png_folder;
  make_folder(folder);
  const std::vector<perceived_place_t> visits =
      options.with_all_visits ? all_visits(source) : shown_visits(source, topology);
  Json written = Json::array();
  Progress progress("drawing places");
  for (const perceived_place_t& seen : visits) {
    const std::filesystem::path file = folder / file_name(seen, options.with_all_visits);
    write_png(draw_perceived_place(seen, {name_of(topology, seen.place_id)}), file);
    written.push_back({{"place", seen.place_id}, {"visit", seen.visit}, {"file", file.string()}});
    progress.show(static_cast<std::int64_t>(written.size()),
                  static_cast<std::int64_t>(visits.size()));
  }
  streams.err << "wrote " << written.size() << " pictures to " << printable(folder.string())
              << '\n';
  return written;
}

void show_places(const PlacesOptions& options, const Streams& streams) {
  if (options.with_all_visits && options.png_folder.empty()) {
    throw Failure(ExitCode::kUsage, "places: --all is of pictures: add --png DIR");
  }
  const std::unique_ptr<MapSource> source = open_source(options.source);
  const cairn_lcm::topology_t topology = source->topology();
  Json pictures;
  if (!options.png_folder.empty()) {
    pictures = draw_pictures(options, topology, *source, streams);
  }
  if (!options.source.as_json) {
    print_places(streams.out, topology);
    return;
  }
  Json json = to_json(topology);
  if (!pictures.is_null()) {
    json["pictures"] = pictures;
  }
  streams.out << dumped(json) << '\n';
}

}  // namespace

void add_places_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand(
      "places",
      "The places of the best map; gateways as number>place, number? if pending, or number!place "
      "where the robot came to a place against the map");
  const auto options = std::make_shared<PlacesOptions>();
  command
      ->add_option("--png", options->png_folder,
                   "Draw what was seen of each place, and why, into this folder")
      ->type_name("DIR");
  command->add_flag("--all", options->with_all_visits,
                    "Draw every visit, not only the one that the map shows");
  add_map_file(*command, &options->source);
  add_hypothesis(*command, &options->source);
  add_json_flag(*command, &options->source.as_json);
  add_link_options(*command, &options->source.link);
  command->callback([options, streams] { show_places(*options, streams); });
}

}  // namespace cairn::clients
