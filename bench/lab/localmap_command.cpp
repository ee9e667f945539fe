#include "bench/lab/localmap_command.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/localmap_ablations.hpp"
#include "bench/lab/localmap_picture.hpp"
#include "bench/lab/localmap_relations.hpp"
#include "bench/lab/localmap_run.hpp"
#include "bench/lab/place_pictures.hpp"
#include "bench/lab/places_run.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

std::array<std::pair<const char*, const StageTimes*>, 4> stages_of(const LocalmapRun& run) {
  return {{{"matching", &run.matching},
           {"insertion", &run.insertion},
           {"other", &run.other},
           {"all", &run.all}}};
}

OrderedJson json_of(const ErrorMoments& moments) {
  return {{"mean", moments.mean}, {"deviation", moments.deviation}, {"max", moments.max}};
}

OrderedJson json_of(const RelationErrors& errors) {
  return {{"relations", errors.relations},
          {"translation_m", json_of(errors.translation_m)},
          {"rotation_deg", json_of(errors.rotation_deg)},
          {"drift_m_per_m", errors.drift_per_travel}};
}

OrderedJson json_of(const LocalmapRun& run, const std::optional<RelationReport>& report) {
  OrderedJson json = {{"scans", run.track.size()},
                      {"travel_m", run.travel_m()},
                      {"refused", run.refused},
                      {"restarts", run.restarts},
                      {"renewals", run.renewals},
                      {"scan_lag_s", run.scan_lag_s},
                      {"degenerate", run.degenerate},
                      {"notes", run.notes},
                      {"faults", run.faults},
                      {"scans_without_odometry", run.joiner.scans_without_odometry},
                      {"inputs",
                       {{"refused_messages", run.refused_messages},
                        {"last_refusal", run.last_refusal},
                        {"laser_changes", run.laser_changes},
                        {"duplicate_scans_dropped", run.joiner.duplicates},
                        {"stray_stamps_dropped", run.joiner.strays},
                        {"repeated_stamps", run.joiner.repeated},
                        {"out_of_order", run.joiner.out_of_order},
                        {"clock_steps", run.joiner.clock_steps}}},
                      {"map_bytes", run.map_bytes},
                      {"peak_resident_bytes", peak_resident_bytes()},
                      {"damage", run.damage}};
  for (const auto& [name, times] : stages_of(run)) {
    json["cpu_ms"][name] = {{"mean", times->mean_ms()},
                            {"p50", times->quantile_ms(0.5)},
                            {"p99", times->quantile_ms(0.99)},
                            {"max", times->quantile_ms(1.0)}};
  }
  if (report) {
    json["relations"] = {{"missing", report->missing},
                         {"near_m", report->near_m},
                         {"all", json_of(report->all)},
                         {"near", json_of(report->near)},
                         {"near_and_sure", json_of(report->near_and_sure)}};
  }
  return json;
}

void print(const RelationErrors& errors, const std::string& which, std::ostream& out) {
  const auto line = [&out](const char* name, const ErrorMoments& moments, const char* unit) {
    out << "  " << name << ' ' << fixed(moments.mean, 4) << " +- " << fixed(moments.deviation, 4)
        << " max " << fixed(moments.max, 4) << ' ' << unit << '\n';
  };
  out << "relations " << which << ": " << grouped(errors.relations) << '\n';
  line("translation", errors.translation_m, "m");
  line("rotation", errors.rotation_deg, "deg");
  out << "  drift " << fixed(1e3 * errors.drift_per_travel, 2) << " mm per metre travelled\n";
}

/// What was wrong with the log's messages; nothing where all was well.
void print_inputs(const LocalmapRun& run, std::ostream& out) {
  const auto line = [&out](const std::string& what, auto count, const std::string& more = {}) {
    if (count > 0) {
      out << "  input, " << what << ": " << grouped(static_cast<std::int64_t>(count)) << more
          << '\n';
    }
  };
  line("messages refused by their content", run.refused_messages,
       "; the last by " + run.last_refusal);
  line("changes of a laser's beams or view", run.laser_changes);
  line("duplicate scans dropped", run.joiner.duplicates);
  line("stray stamps dropped", run.joiner.strays);
  line("repeated stamps", run.joiner.repeated);
  line("scans out of order", run.joiner.out_of_order);
  line("clock steps", run.joiner.clock_steps);
}

void print(const LocalmapRun& run, const std::optional<RelationReport>& report, std::ostream& out) {
  out << grouped(static_cast<std::int64_t>(run.track.size())) << " scans, "
      << fixed(run.travel_m(), 1) << " m; refused " << run.refused << ", restarts " << run.restarts
      << ", renewals " << run.renewals << ", scans late by " << fixed(run.scan_lag_s, 2)
      << " s, degenerate " << run.degenerate << "; local map "
      << clients::byte_size(static_cast<std::int64_t>(run.map_bytes)) << '\n';
  for (const auto& [note, count] : run.notes) {
    out << "  " << note << ": " << grouped(count) << '\n';
  }
  for (const auto& [fault, count] : run.faults) {
    out << "  odometry against scans, " << fault << ": " << grouped(count) << '\n';
  }
  print_inputs(run, out);
  clients::Table table({"CPU ms per scan", "mean", "median", "99 %", "most"});
  for (const auto& [name, times] : stages_of(run)) {
    table.add({name, fixed(times->mean_ms(), 4), fixed(times->quantile_ms(0.5), 4),
               fixed(times->quantile_ms(0.99), 4), fixed(times->quantile_ms(1.0), 4)});
  }
  table.print(out);
  if (report) {
    print(report->all, "(" + grouped(report->missing) + " missing)", out);
    print(report->near, "within " + fixed(report->near_m, 0) + " m of travel", out);
    print(report->near_and_sure, "of these with both stamps borne by one pose", out);
  }
}

std::string trajectory_of(const LocalmapRun& run) {
  std::string text = "# t x y theta\n";
  for (const TrackedPose& scan : run.poses) {
    std::array<char, 128> line{};
    const Pose2& pose = scan.T_lpm_robot;
    const int length = std::snprintf(line.data(), line.size(), "%.6f %.9f %.9f %.9f\n", scan.time_s,
                                     pose.x(), pose.y(), pose.theta());
    text.append(line.data(), static_cast<std::size_t>(length));
  }
  return text;
}

int track(const LocalmapRequest& request, const Streams& streams) {
  check_outputs({request.log, request.config_file, request.relations_file},
                {request.trajectory_file, request.png_file, request.places_folder});
  LocalmapSetup setup{options_from_file(request.config_file)};
  if (!request.matcher.empty()) {
    const std::optional<MatcherKind> kind = matcher_kind_of(request.matcher);
    if (!kind) {
      throw Failure(ExitCode::kUsage, "--matcher: either correlative or particles");
    }
    setup.options.service.lpm.matcher = *kind;
  }
  for (const std::string& part : request.without) {
    leave_out(part, &setup);
  }
  std::vector<Relation> relations;
  if (!request.relations_file.empty()) {
    relations = read_relations(request.relations_file);
  }
  if (!request.places_folder.empty()) {
    clients::make_folder(request.places_folder);  // Rather now than after a long run.
  }
  const LocalmapRun run = run_localmap(request.log, setup);
  std::optional<RelationReport> report;
  if (!request.relations_file.empty()) {
    report = judge(relations, run.poses);
  }
  if (request.as_json) {
    streams.out << json_of(run, report).dump(2) << '\n';
  } else {
    print(run, report, streams.out);
  }
  if (!request.trajectory_file.empty()) {
    clients::write_file(request.trajectory_file, trajectory_of(run));
  }
  if (!request.png_file.empty()) {
    draw_localmap(run, request.png_file);
  }
  if (!request.places_folder.empty()) {
    const DaemonOptions& options = setup.options;
    draw_places(run_places(request.log, options).visits, options.service.place,
                request.places_folder);
  }
  if (!run.damage.empty()) {
    throw Failure(ExitCode::kBadData, request.log + ": " + run.damage);
  }
  if (report && report->all.relations < report->missing) {
    throw Failure(ExitCode::kBadData,
                  request.relations_file + ": expected most relations to have " +
                      "both ends in the log, " + grouped(report->all.relations) + " of " +
                      grouped(report->all.relations + report->missing) +
                      " have; are they of another log?");
  }
  return 0;
}

}  // namespace

void add_localmap_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "localmap", "Track a recorded log by the local layer alone: how fast, how true");
  auto request = std::make_shared<LocalmapRequest>();
  const auto file = [&](const char* name, std::string* path, const char* help) {
    return command->add_option(name, *path, help)->type_name("FILE");
  };
  file("LOG", &request->log, "CARMEN log, or LCM event log")->required();
  file("--config", &request->config_file, "The daemon's configuration");
  command->add_option("--matcher", request->matcher, "correlative or particles")->type_name("NAME");
  command->add_option("--without", request->without, "Leave parts out, to see what they are worth")
      ->delimiter(',')
      ->type_name("PART,...");
  file("--relations", &request->relations_file, "True relations of poses: report the error");
  file("--png", &request->png_file, "Draw what was seen, and the way");
  file("--trajectory", &request->trajectory_file, "The poses, as lines t x y theta");
  command
      ->add_option("--places", request->places_folder,
                   "Draw each visit to a place into this folder: what was seen, and why")
      ->type_name("DIR");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = track(*request, streams); });
}

}  // namespace cairn::lab
