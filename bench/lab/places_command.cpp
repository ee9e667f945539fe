#include "bench/lab/places_command.hpp"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/localmap_run.hpp"
#include "bench/lab/place_picture.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"
#include "lpm/local_mapper.hpp"
#include "place/place_detector.hpp"
#include "star/small_scale_star.hpp"
#include "transport/inlets.hpp"
#include "wire/log_reader.hpp"

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

struct PlacesRun {
  std::vector<PlaceVisit> visits;
  PlaceDetectorReport report;
  StageTimes perception;
  std::string damage;
};

/// The local layer and the place detector.
class Detecting {
 public:
  Detecting(const DaemonOptions& options, PlacesRun* run)
      : run_(run),
        joiner_(options.service.joiner),
        mapper_(options.service.lpm),
        detector_(options.service.place) {}

  void take(LaserScan scan) {
    joiner_.add(std::move(scan));
    perceive();
  }
  void take(const OdometrySample& sample) {
    joiner_.add(sample);
    perceive();
  }
  void finish() {
    joiner_.flush();
    perceive();
    for (PlaceVisit& visit : detector_.finish()) {
      run_->visits.push_back(std::move(visit));
    }
    run_->report = detector_.report();
  }

 private:
  void perceive() {
    while (const std::optional<JoinedScan> joined = joiner_.next()) {
      const LocalFix fix = mapper_.absorb(*joined);
      const double start_s = cpu_time_s();
      for (PlaceEvent& event : detector_.observe(fix.time, fix.T_lpm_robot, mapper_.grid())) {
        if (event.visit) {
          run_->visits.push_back(*std::move(event.visit));
        }
      }
      run_->perception.times_ms.push_back(1e3 * (cpu_time_s() - start_s));
    }
  }

  PlacesRun* run_;
  ScanJoiner joiner_;
  LocalMapper mapper_;
  PlaceDetector detector_;
};

PlacesRun run_places(const std::string& log, const DaemonOptions& options) {
  wire::Expected<wire::LogReader> reader = wire::LogReader::open(log);
  if (!reader) {
    throw Failure(ExitCode::kBadData, reader.error());
  }
  PlacesRun run;
  Detecting detecting(options, &run);
  Inlets inlets(
      to_inlet_options(options),
      {[&](LaserScan scan) { detecting.take(std::move(scan)); },
       [&](const OdometrySample& sample) { detecting.take(sample); }, [](const SonarRing&) {}});
  clients::Progress progress(log);
  while (const std::optional<wire::LogMessage> message = reader->next()) {
    inlets.dispatch(message->channel, message->bytes.data(), message->bytes.size());
    progress.show(reader->bytes_read(), reader->bytes_total());
  }
  detecting.finish();
  if (run.perception.times_ms.empty()) {
    throw Failure(ExitCode::kBadData,
                  log + ": no scan in it" + (reader->damage() ? "; " + *reader->damage() : ""));
  }
  run.damage = reader->damage().value_or("");
  return run;
}

double seconds_of(TimePoint time) {
  return static_cast<double>(utime_of(time)) * 1e-6;
}

OrderedJson json_of(const Gateway& gateway) {
  return {{"x_m", gateway.middle.x()},
          {"y_m", gateway.middle.y()},
          {"width_m", gateway.width_m},
          {"outward_bearing_rad", gateway.outward_bearing_rad},
          {"seen_beyond_m", gateway.seen_beyond_m}};
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
                      {"gateways", OrderedJson::array()}};
  for (const Gateway& gateway : visit.neighbourhood.gateways) {
    json["gateways"].push_back(json_of(gateway));
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
                      {"visits", OrderedJson::array()}};
  for (const PlaceVisit& visit : run.visits) {
    json["visits"].push_back(json_of(visit));
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
    draw_places(run.visits, options.service.place, request.png_file);
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
