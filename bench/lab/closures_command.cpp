#include "bench/lab/closures_command.hpp"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/closure_truth.hpp"
#include "bench/lab/localmap_run.hpp"
#include "bench/lab/log_feed.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"
#include "service/mapping_service.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

struct ClosuresRequest {
  std::string log;
  std::string reference_file;
  std::string config_file;
  double same_m = 2.5;
  bool as_json = false;
  bool says_why = false;
};

struct MappedLog {
  std::vector<JudgedVisit> visits;
  std::vector<std::string> decisions;  ///< By visit: what it might have been, and what decided.
  std::int64_t guarantee_given_up_at = -1;
  double probability = 0.0;
  std::string damage;
};

/// Where the origin of a visit's place is by the reference.
std::optional<Vector2d> place_by_reference(const Experience& experience,
                                           const Visit& visit,
                                           const std::vector<ReferencePose>& reference) {
  const LocalFix& fix = experience.scans()[visit.anchor_scan].fix;
  const std::optional<Pose2> T_reference_robot = reference_at(reference, seconds_of(fix.time));
  if (!T_reference_robot) {
    return std::nullopt;
  }
  return *T_reference_robot *
         (fix.T_lpm_robot.inverse() * visit.perceived.T_lpm_place.translation());
}

/// All that a visit might have been to the best map, one to a line, what it was taken for first.
std::string decision_at(const HypothesisTree& tree, VisitId visit) {
  std::string taken;
  std::string others;
  for (const Considered& one : tree.explanation(tree.best().id, visit)) {
    (one.is_taken ? taken : others) += "    " + one.sentence + '\n';
  }
  return taken + others;
}

MappedLog map_log(const ClosuresRequest& request, const std::vector<ReferencePose>& reference) {
  const DaemonOptions options = options_from_file(request.config_file);
  MappingService service(options.service);
  MappedLog mapped;
  mapped.damage =
      feed_log(request.log, options,
               {[&](LaserScan scan) { static_cast<void>(service.absorb(std::move(scan))); },
                [&](const OdometrySample& sample) { static_cast<void>(service.absorb(sample)); },
                {},
                {},
                {}});
  static_cast<void>(service.finish());
  if (service.experience().scans().empty()) {
    refuse_without_scans(request.log, mapped.damage);
  }
  const std::shared_ptr<const MapState> state = service.state();
  const std::vector<Visit>& visits = service.experience().visits();
  for (std::size_t v = 0; v < visits.size() && v < state->place_of_visit.size(); ++v) {
    mapped.visits.push_back(
        {state->place_of_visit[v], place_by_reference(service.experience(), visits[v], reference)});
  }
  for (std::size_t v = 0; request.says_why && v < mapped.visits.size(); ++v) {
    mapped.decisions.push_back(decision_at(service.tree(), VisitId{static_cast<int>(v)}));
  }
  mapped.guarantee_given_up_at = state->guarantee_given_up_at;
  mapped.probability = state->probability;
  return mapped;
}

OrderedJson json_of(const std::vector<WrongVisit>& wrong) {
  OrderedJson json = OrderedJson::array();
  for (const WrongVisit& visit : wrong) {
    json.push_back(
        {{"visit", visit.visit}, {"other", visit.other}, {"distance_m", visit.distance_m}});
  }
  return json;
}

void print_json(const MappedLog& mapped, const ClosureReport& report, std::ostream& out) {
  const OrderedJson json = {
      {"visits", report.visits},           {"places", report.places},
      {"not_judged", report.unknown},      {"revisits", report.revisits},
      {"closures", report.closures},       {"found_share", report.found_share()},
      {"merged", json_of(report.merged)},  {"missed", json_of(report.missed)},
      {"probability", mapped.probability}, {"guarantee_given_up_at", mapped.guarantee_given_up_at}};
  out << json.dump(2) << '\n';
}

void print(const MappedLog& mapped, const ClosureReport& report, std::ostream& out) {
  const auto list = [&](const char* what, const std::vector<WrongVisit>& wrong) {
    for (const WrongVisit& visit : wrong) {
      out << "  visit " << visit.visit << what << visit.other << ", " << fixed(visit.distance_m, 1)
          << " m away by the reference\n"
          << (mapped.decisions.empty() ? "" : mapped.decisions[visit.visit]);
    }
  };
  out << report.visits << " visits to " << report.places << " places";
  if (report.unknown > 0) {
    out << ", " << report.unknown << " not judged: the reference does not reach them";
  }
  out << "\nrecognised " << report.revisits << " of " << report.revisits + report.missed.size()
      << " visits to known places, " << report.closures << " by a new way (loops closed)\n";
  out << "wrongly merged " << report.merged.size() << '\n';
  list(" taken for the place of visit ", report.merged);
  out << "not recognised " << report.missed.size() << '\n';
  list(" not taken for the place of visit ", report.missed);
  out << "probability of the map " << fixed(mapped.probability, 3) << "; guarantee "
      << (mapped.guarantee_given_up_at < 0
              ? "kept"
              : "given up at visit " + std::to_string(mapped.guarantee_given_up_at))
      << '\n';
}

int judge_log(const ClosuresRequest& request, const Streams& streams) {
  const std::vector<ReferencePose> reference = read_reference(request.reference_file);
  const MappedLog mapped = map_log(request, reference);
  const ClosureReport report = judge_closures(mapped.visits, request.same_m);
  if (report.visits > 0 && report.visits == report.unknown) {
    throw Failure(ExitCode::kBadData,
                  request.reference_file + ": reaches no visit of the log; is it of another log?");
  }
  if (request.as_json) {
    print_json(mapped, report, streams.out);
  } else {
    print(mapped, report, streams.out);
  }
  if (!mapped.damage.empty()) {
    throw Failure(ExitCode::kBadData, request.log + ": " + mapped.damage);
  }
  return report.merged.empty() ? 0 : 1;
}

}  // namespace

void add_closures_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "closures", "Map a recorded log and hold its places against a reference trajectory");
  auto request = std::make_shared<ClosuresRequest>();
  const auto file = [&](const char* name, std::string* path, const char* help) {
    return command->add_option(name, *path, help)->type_name("FILE");
  };
  file("LOG", &request->log, "CARMEN log, or LCM event log")->required();
  file("--reference", &request->reference_file, "Lines `time x y theta` of where the robot was")
      ->required();
  file("--config", &request->config_file, "The daemon's configuration");
  command
      ->add_option("--same", request->same_m,
                   "Visits are to one place if by the reference they lie within this, m")
      ->check(clients::within(0.1, 100.0))
      ->capture_default_str();
  command->add_flag("--why", request->says_why,
                    "Of each wrong visit all that it might have been to the map, and what decided");
  command->add_flag("--json", request->as_json, "Print JSON")->excludes("--why");
  command->callback([request, streams, status] { *status = judge_log(*request, streams); });
}

}  // namespace cairn::lab
