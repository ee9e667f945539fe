#include "bench/lab/trajectory_command.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/localmap_relations.hpp"
#include "bench/lab/log_feed.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/trajectory_errors.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "service/mapping_service.hpp"
#include "service/refined_map.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kTravelsShown = 10;

struct TrajectoryRequest {
  std::string log;
  std::string relations_file;
  std::string config_file;
  bool as_json = false;
};

/// One way to tell where the robot was.
struct JudgedTrajectory {
  const char* name = "";
  RelationReport report;
};

struct TrajectoryRun {
  std::vector<JudgedTrajectory> trajectories;  ///< The last one is what is published.
  std::vector<TravelShare> travels;            ///< Of the last one.
  std::int64_t visits = 0;
  std::size_t places = 0;
  double refine_ms = 0.0;  ///< CPU time.
  std::string damage;
};

std::vector<TrackedPose> track_of(const MapState& state) {
  std::vector<TrackedPose> track;
  double travel_m = 0.0;
  for (const TimedPose& posed : one_pose_for_each_time(state.poses)) {
    if (!track.empty()) {
      travel_m +=
          (posed.T_global_robot.translation() - track.back().T_lpm_robot.translation()).norm();
    }
    track.push_back({seconds_of(posed.time), posed.T_global_robot, travel_m, posed.is_of_scan});
  }
  return track;
}

std::vector<TravelSpan> spans_of(const Experience& experience) {
  std::vector<TravelSpan> spans;
  const auto time_of = [&](std::size_t scan) {
    return seconds_of(experience.scans()[scan].fix.time);
  };
  std::size_t begin = 0;
  for (std::size_t visit = 0; visit < experience.visits().size(); ++visit) {
    spans.push_back({static_cast<std::int64_t>(visit), time_of(begin)});
    begin = experience.visits()[visit].anchor_scan;
  }
  spans.push_back({static_cast<std::int64_t>(experience.visits().size()), time_of(begin)});
  // Stamps may step back.
  std::stable_sort(spans.begin(), spans.end(),
                   [](const TravelSpan& a, const TravelSpan& b) { return a.begin_s < b.begin_s; });
  return spans;
}

TrajectoryRun run_log(const TrajectoryRequest& request, const std::vector<Relation>& relations) {
  const DaemonOptions options = options_from_file(request.config_file);
  MappingService service(options.service);
  TrajectoryRun run;
  run.damage =
      feed_log(request.log, options,
               {[&](LaserScan scan) { static_cast<void>(service.absorb(std::move(scan))); },
                [&](const OdometrySample& sample) { static_cast<void>(service.absorb(sample)); },
                {},
                {},
                {}});
  static_cast<void>(service.finish());
  if (service.experience().scans().empty()) {
    refuse_without_scans(request.log, run.damage);
  }
  const std::shared_ptr<const MapState> interpolated = service.state();
  const double start_ms = 1e3 * cpu_time_s();
  MapRefiner refiner(options.service.refinement);
  const std::shared_ptr<const MapState> refined = refiner.refined(interpolated);
  run.refine_ms = 1e3 * cpu_time_s() - start_ms;
  run.trajectories = {{"interpolated", judge(relations, track_of(*interpolated))},
                      {"refined", judge(relations, track_of(*refined))}};
  run.travels = shares_of_travels(relations, track_of(*refined), spans_of(service.experience()));
  run.visits = refined->visit_count;
  run.places = refined->places.size();
  return run;
}

OrderedJson json_of(const RelationErrors& errors) {
  return {{"relations", errors.relations},
          {"mean_m", errors.translation_m.mean},
          {"deviation_m", errors.translation_m.deviation},
          {"max_m", errors.translation_m.max},
          {"mean_deg", errors.rotation_deg.mean},
          {"deviation_deg", errors.rotation_deg.deviation},
          {"max_deg", errors.rotation_deg.max}};
}

void print_json(const TrajectoryRun& run, std::ostream& out) {
  OrderedJson json = {{"visits", run.visits},
                      {"places", run.places},
                      {"missing", run.trajectories.back().report.missing},
                      {"refine_ms", run.refine_ms}};
  for (const JudgedTrajectory& trajectory : run.trajectories) {
    json[trajectory.name] = {{"all", json_of(trajectory.report.all)},
                             {"near", json_of(trajectory.report.near)}};
  }
  json["travels"] = OrderedJson::array();
  for (const TravelShare& travel : run.travels) {
    json["travels"].push_back({{"to_visit", travel.visit},
                               {"relation_ends", travel.relations},
                               {"mean_m", travel.mean_m},
                               {"share", travel.share}});
  }
  out << json.dump(2) << '\n';
}

void print(const TrajectoryRun& run, std::ostream& out) {
  const auto column = [&out](const std::string& text, std::size_t width) {
    out << std::string(text.size() < width ? width - text.size() : 1, ' ') << text;
  };
  out << run.visits << " visits to " << run.places << " places; refined in "
      << fixed(run.refine_ms, 0) << " ms; " << run.trajectories.back().report.missing
      << " relations without poses\n"
      << "                      relations   mean m       +-      max   mean deg       +-      "
         "max\n";
  for (const JudgedTrajectory& trajectory : run.trajectories) {
    for (const bool is_near : {false, true}) {
      const RelationErrors& errors = is_near ? trajectory.report.near : trajectory.report.all;
      const std::string name = std::string(trajectory.name) + (is_near ? ", near" : "");
      out << name << std::string(20 - std::min<std::size_t>(name.size(), 20), ' ');
      column(std::to_string(errors.relations), 11);
      for (const double value :
           {errors.translation_m.mean, errors.translation_m.deviation, errors.translation_m.max}) {
        column(fixed(value, 4), 9);
      }
      column(fixed(errors.rotation_deg.mean, 3), 11);
      column(fixed(errors.rotation_deg.deviation, 3), 9);
      column(fixed(errors.rotation_deg.max, 2), 9);
      out << '\n';
    }
  }
  out << "near: ends within " << fixed(run.trajectories.back().report.near_m, 0)
      << " m of travel. Of the refined errors, by the travels in which relations end:\n"
      << "travel to visit   ends   mean m   share of all errors\n";
  for (std::size_t i = 0; i < std::min(kTravelsShown, run.travels.size()); ++i) {
    const TravelShare& travel = run.travels[i];
    column(std::to_string(travel.visit), 15);
    column(std::to_string(travel.relations), 7);
    column(fixed(travel.mean_m, 4), 9);
    column(fixed(100.0 * travel.share, 1) + " %", 12);
    out << '\n';
  }
}

void judge_log(const TrajectoryRequest& request, const Streams& streams) {
  const std::vector<Relation> relations = read_relations(request.relations_file);
  const TrajectoryRun run = run_log(request, relations);
  const RelationReport& report = run.trajectories.back().report;
  if (report.all.relations < report.missing) {
    throw Failure(
        ExitCode::kBadData,
        request.relations_file + ": most relations have no pose in the log; is it of another log?");
  }
  if (request.as_json) {
    print_json(run, streams.out);
  } else {
    print(run, streams.out);
  }
  if (!run.damage.empty()) {
    throw Failure(ExitCode::kBadData, request.log + ": " + run.damage);
  }
}

}  // namespace

void add_trajectory_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand(
      "trajectory", "Map a recorded log and hold its trajectory against true relations");
  auto request = std::make_shared<TrajectoryRequest>();
  const auto file = [&](const char* name, std::string* path, const char* help) {
    return command->add_option(name, *path, help)->type_name("FILE");
  };
  file("LOG", &request->log, "CARMEN log, or LCM event log")->required();
  file("--relations", &request->relations_file, "Lines `t1 t2 x y z roll pitch yaw`")->required();
  file("--config", &request->config_file, "The daemon's configuration");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams] { judge_log(*request, streams); });
}

}  // namespace cairn::lab
