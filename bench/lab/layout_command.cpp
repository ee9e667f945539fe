#include "bench/lab/layout_command.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/pose_graph.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"
#include "layout/layout_attempt.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;
using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

constexpr char kFromFile[] = "file";
constexpr char kFromChordal[] = "chordal";
/// Below this share of chi2 two starts ended in the same least.
constexpr double kSameShare = 1e-6;

struct LayoutRequest {
  std::string graph_file;
  std::string start = kFromChordal;
  std::string out_file;
  LayoutOptions options;
  bool as_json = false;
};

/// What came of one start.
struct Trial {
  std::string start;
  double chi2 = 0.0;
  LayoutAttempt attempt;
};

struct LayoutRun {
  PoseGraph graph;
  std::vector<Trial> trials;  ///< The one that was asked for first.
  std::size_t best = 0;
  double initial_chi2 = 0.0;  ///< Of the start that was asked for.
  double read_ms = 0.0;       ///< CPU time, as is time_ms.
  double time_ms = 0.0;       ///< Of all trials, with the linear start.
};

std::string content_of(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw Failure(ExitCode::kBadData, clients::printable(path) + ": expected a file, got a folder");
  }
  if (!std::filesystem::exists(path, error)) {
    throw Failure(ExitCode::kBadData, clients::printable(path) + ": no such file");
  }
  const std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) {
    throw Failure(ExitCode::kBadData, clients::printable(path) + ": cannot be read");
  }
  return content.str();
}

PoseGraph read_graph(const LayoutRequest& request) {
  Result<PoseGraph> graph = parse_pose_graph(content_of(request.graph_file));
  if (!graph) {
    throw Failure(ExitCode::kBadData,
                  clients::printable(request.graph_file) + ": " + graph.error().message);
  }
  if (request.start == kFromFile && graph->T_frame_vertex.empty()) {
    throw Failure(ExitCode::kBadData,
                  clients::printable(request.graph_file) +
                      ": --init file: expected vertices with poses, got edges alone; expected "
                      "--init chordal");
  }
  return *std::move(graph);
}

Trial tried(const LayoutRequest& request,
            const PoseGraph& graph,
            const std::vector<TravelConstraint>& travels,
            bool is_from_file) {
  Result<LayoutAttempt> attempt =
      attempt_layout(static_cast<int>(graph.ids.size()), travels, request.options,
                     is_from_file ? &graph.T_frame_vertex : nullptr);
  if (!attempt) {
    throw Failure(ExitCode::kBadData,
                  clients::printable(request.graph_file) + ": " + attempt.error().message);
  }
  return {is_from_file ? kFromFile : kFromChordal, 0.0, *std::move(attempt)};
}

bool is_better(const Trial& a, const Trial& b) {
  return a.attempt.is_converged != b.attempt.is_converged ? a.attempt.is_converged
                                                          : a.chi2 < b.chi2;
}

LayoutRun run_layout(const LayoutRequest& request) {
  LayoutRun run;
  const Elapsed elapsed("laying out " + clients::printable(request.graph_file));
  const double begin_s = cpu_time_s();
  run.graph = read_graph(request);
  const std::vector<TravelConstraint> travels = travels_of(run.graph);
  const double read_s = cpu_time_s();
  if (request.start == kFromFile) {
    run.trials.push_back(tried(request, run.graph, travels, true));
  }
  // Poses of a file may lead to a least that is not the lowest: never rely on them alone.
  run.trials.push_back(tried(request, run.graph, travels, false));
  run.time_ms = 1e3 * (cpu_time_s() - read_s);
  run.read_ms = 1e3 * (read_s - begin_s);
  for (Trial& trial : run.trials) {
    trial.chi2 = chi2_of(run.graph, trial.attempt.layout.T_global_place);
  }
  run.best = run.trials.size() > 1 && is_better(run.trials[1], run.trials[0]) ? 1 : 0;
  run.initial_chi2 = request.start == kFromFile ? chi2_of(run.graph, run.graph.T_frame_vertex)
                                                : run.trials.front().attempt.initial_chi2;
  return run;
}

OrderedJson json_of(const LayoutRun& run) {
  const Trial& best = run.trials[run.best];
  OrderedJson json = {{"vertices", run.graph.ids.size()},
                      {"edges", run.graph.edges.size()},
                      {"parallel_edges", run.graph.parallel_edges},
                      {"chi2", best.chi2},
                      {"initial_chi2", run.initial_chi2},
                      {"iterations", best.attempt.layout.iterations},
                      {"time_ms", run.time_ms},
                      {"read_ms", run.read_ms},
                      {"converged", best.attempt.is_converged},
                      {"start", best.start},
                      {"starts", OrderedJson::array()}};
  for (const Trial& trial : run.trials) {
    json["starts"].push_back({{"start", trial.start},
                              {"initial_chi2", trial.attempt.initial_chi2},
                              {"chi2", trial.chi2},
                              {"iterations", trial.attempt.layout.iterations},
                              {"converged", trial.attempt.is_converged}});
  }
  return json;
}

/// Eight significant digits.
std::string significant(double value) {
  std::ostringstream text;
  text.precision(8);
  text << value;
  return text.str();
}

/// Why it is this trial of two that counts.
void print_choice(const LayoutRun& run, std::ostream& out) {
  const Trial& asked = run.trials.front();
  const Trial& other = run.trials[1];
  if (run.best == 0) {
    out << "  the chordal start does no better\n";
  } else if (!asked.attempt.is_converged) {
    out << "  from the file's poses it does not converge: the chordal start is taken\n";
  } else if (asked.chi2 > other.chi2 * (1.0 + kSameShare)) {
    out << "  the file's poses lead to a least that is not the lowest: the chordal start is "
           "taken\n";
  } else {
    out << "  both starts end in the same least\n";
  }
}

void print(const LayoutRun& run, const std::string& file, std::ostream& out) {
  const Trial& best = run.trials[run.best];
  const auto count = [](std::size_t size) { return grouped(static_cast<std::int64_t>(size)); };
  out << clients::printable(file) << ": " << count(run.graph.ids.size()) << " vertices, "
      << count(run.graph.edges.size()) << " edges";
  if (run.graph.parallel_edges > 0) {
    out << " (" << count(static_cast<std::size_t>(run.graph.parallel_edges))
        << " measure what another one does, and all count)";
  }
  out << '\n';
  for (const Trial& trial : run.trials) {
    out << "  from the " << (trial.start == kFromFile ? "file's poses" : "chordal start")
        << ": chi2 " << significant(trial.attempt.initial_chi2) << " -> " << significant(trial.chi2)
        << ", " << trial.attempt.layout.iterations << " iterations"
        << (trial.attempt.is_converged ? "" : ", NOT CONVERGED") << '\n';
  }
  if (run.trials.size() > 1) {
    print_choice(run, out);
  }
  if (best.attempt.is_converged) {
    out << "  chi2 " << significant(best.chi2) << ", converged";
  } else {
    out << "  no layout: not converged (" << clients::printable(best.attempt.reason) << ")";
  }
  out << "; " << fixed(run.time_ms, 2) << " ms of CPU time, " << fixed(run.read_ms, 2)
      << " ms to read\n";
}

/// The anchor stays where the file has it, else at the origin.
std::vector<Pose2> placed(const LayoutRun& run) {
  std::vector<Pose2> poses = run.trials[run.best].attempt.layout.T_global_place;
  const auto anchor = static_cast<std::size_t>(run.graph.anchor);
  const Pose2 T_frame_anchor =
      run.graph.T_frame_vertex.empty() ? Pose2() : run.graph.T_frame_vertex[anchor];
  const Pose2 T_frame_global = T_frame_anchor * poses[anchor].inverse();
  for (Pose2& pose : poses) {
    pose = T_frame_global * pose;
  }
  return poses;
}

int lay_out(const LayoutRequest& request, const Streams& streams) {
  check_outputs({request.graph_file}, {request.out_file});
  const LayoutRun run = run_layout(request);
  const bool is_converged = run.trials[run.best].attempt.is_converged;
  if (is_converged && !request.out_file.empty()) {
    clients::write_file(request.out_file, to_g2o(run.graph, placed(run)));
  }
  if (request.as_json) {
    streams.out << json_of(run).dump(2) << '\n';
  } else {
    print(run, request.graph_file, streams.out);
  }
  if (!is_converged && !request.out_file.empty()) {
    streams.err << "cairn-lab: " << clients::printable(request.out_file)
                << ": not written, for there is no layout\n";
  }
  return is_converged ? 0 : 1;
}

}  // namespace

void add_layout_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command =
      app.add_subcommand("layout", "The most likely layout of a 2D pose graph (g2o or TORO)");
  auto request = std::make_shared<LayoutRequest>();
  const auto empty_name = [](const std::string& name) {
    return name.empty() ? "expected the name of a file, got an empty one" : std::string();
  };
  command->add_option("GRAPH", request->graph_file, "Pose graph, g2o or TORO")
      ->type_name("FILE")
      ->check(empty_name)
      ->required();
  command
      ->add_option("--init", request->start,
                   "Where to begin: the linear (chordal) start, or the file's poses as well")
      ->type_name("file|chordal")
      ->check(CLI::IsMember({kFromFile, kFromChordal}))
      ->capture_default_str();
  command->add_option("--out", request->out_file, "Write the graph as laid out, g2o")
      ->type_name("FILE")
      ->check(empty_name);
  command
      ->add_option("--max-iterations", request->options.max_iterations,
                   "Give up where so many steps do not converge")
      ->type_name("N")
      ->check(clients::within(1, 10'000))
      ->capture_default_str();
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = lay_out(*request, streams); });
}

}  // namespace cairn::lab
