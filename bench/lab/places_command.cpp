#include "bench/lab/places_command.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/log_feed.hpp"
#include "bench/lab/place_pictures.hpp"
#include "bench/lab/places_run.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "star/small_scale_star.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

struct PlacesRequest {
  std::string log;
  std::string config_file;
  std::string png_file;
  bool as_json = false;
};

OrderedJson json_of(const Gateway& gateway) {
  return {{"x_m", gateway.middle.x()},
          {"y_m", gateway.middle.y()},
          {"width_m", gateway.width_m},
          {"outward_bearing_rad", gateway.outward_bearing_rad},
          {"seen_beyond_m", gateway.seen_beyond_m}};
}

OrderedJson json_of(const ConsideredOpening& opening) {
  OrderedJson json = json_of(opening.line);
  json["state"] = to_string(opening.state);
  json["reason"] = why(opening);
  json["needed_m"] = opening.needed_m;
  json["wall_share"] = wall_share(opening);
  json["log_odds"] = opening.log_odds;
  return json;
}

OrderedJson json_of(const PlaceVisit& visit) {
  OrderedJson json = {{"entered_s", seconds_of(visit.entered)},
                      {"left_s", seconds_of(visit.left)},
                      {"x_m", visit.T_lpm_place.x()},
                      {"y_m", visit.T_lpm_place.y()},
                      {"arrival_gateway", visit.arrival_gateway},
                      {"departure_gateway", visit.departure_gateway},
                      {"distinctiveness", visit.neighbourhood.distinctiveness},
                      {"star", small_scale_text(visit.neighbourhood.star, 0)},
                      {"gateways", OrderedJson::array()},
                      {"considered", OrderedJson::array()}};
  for (const Gateway& gateway : visit.neighbourhood.gateways) {
    json["gateways"].push_back(json_of(gateway));
  }
  for (const ConsideredOpening& opening : visit.neighbourhood.considered) {
    json["considered"].push_back(json_of(opening));
  }
  return json;
}

OrderedJson json_of(const PlacesRun& run) {
  OrderedJson json = {{"scans", run.perception.times_ms.size()},
                      {"looks", run.report.looks},
                      {"turn_arounds", run.report.turn_arounds},
                      {"dropped_incomplete", run.report.dropped_incomplete},
                      {"cpu_ms",
                       {{"mean", run.perception.mean_ms()},
                        {"p99", run.perception.quantile_ms(0.99)},
                        {"max", run.perception.quantile_ms(1.0)}}},
                      {"visits", OrderedJson::array()},
                      {"poses", OrderedJson::array()}};
  for (const PlaceVisit& visit : run.visits) {
    json["visits"].push_back(json_of(visit));
  }
  for (const LookedPose& pose : run.poses) {
    json["poses"].push_back({{"time_s", pose.time_s},
                             {"x_m", pose.T_lpm_robot.x()},
                             {"y_m", pose.T_lpm_robot.y()},
                             {"distinctiveness", pose.island.distinctiveness}});
  }
  return json;
}

void print(const PlacesRun& run, std::ostream& out) {
  clients::Table table(
      {"visit", "x_m", "y_m", "in", "out", "distinct", "gateways: width/seen beyond, m"});
  for (std::size_t i = 0; i < run.visits.size(); ++i) {
    const PlaceVisit& visit = run.visits[i];
    std::string gateways;
    for (const Gateway& gateway : visit.neighbourhood.gateways) {
      gateways += (gateways.empty() ? "" : "  ") + fixed(gateway.width_m, 1) + "/" +
                  fixed(gateway.seen_beyond_m, 1);
    }
    table.add({std::to_string(i), fixed(visit.T_lpm_place.x(), 1), fixed(visit.T_lpm_place.y(), 1),
               std::to_string(visit.arrival_gateway), std::to_string(visit.departure_gateway),
               fixed(visit.neighbourhood.distinctiveness, 2), gateways});
  }
  table.print(out);
  out << run.visits.size() << " visits; " << grouped(run.report.looks) << " looks, "
      << run.report.turn_arounds << " turned around, " << run.report.dropped_incomplete
      << " dropped as incomplete; CPU ms per scan " << fixed(run.perception.mean_ms(), 3)
      << ", 99 % " << fixed(run.perception.quantile_ms(0.99), 2) << ", most "
      << fixed(run.perception.quantile_ms(1.0), 2) << '\n';
}

int perceive(const PlacesRequest& request, const Streams& streams) {
  check_outputs({request.log, request.config_file}, {request.png_file});
  const DaemonOptions options = options_from_file(request.config_file);
  const PlacesRun run = run_places(request.log, options);
  if (request.as_json) {
    streams.out << json_of(run).dump(2) << '\n';
  } else {
    print(run, streams.out);
  }
  if (!request.png_file.empty()) {
    draw_place_sheet(run.visits, options.service.place, request.png_file);
  }
  if (!run.damage.empty()) {
    throw Failure(ExitCode::kBadData, request.log + ": " + run.damage);
  }
  return 0;
}

}  // namespace

void add_places_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command =
      app.add_subcommand("places", "Find the places on the way of a recorded log, and draw them");
  auto request = std::make_shared<PlacesRequest>();
  const auto file = [&](const char* name, std::string* path, const char* help) {
    return command->add_option(name, *path, help)->type_name("FILE");
  };
  file("LOG", &request->log, "CARMEN log, or LCM event log")->required();
  file("--config", &request->config_file, "The daemon's configuration");
  file("--png", &request->png_file, "Draw what was perceived at each visit");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = perceive(*request, streams); });
}

}  // namespace cairn::lab
