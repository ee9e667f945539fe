// The layout held against a plain Ceres program, the text-book pose graph with automatic
// derivatives and default options, over the same graphs in one run. CPU time with the initial
// guess and without reading; the least of a few repetitions each, alternating.
//
//     layout_against_ceres GRAPH.g2o...

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "bench/lab/pose_graph.hpp"
#include "bench/lab/resources.hpp"
#include "layout/elimination_order.hpp"
#include "layout/layout_attempt.hpp"
#include "layout/linear_start.hpp"

namespace cairn {
namespace {

constexpr int kRepetitions = 5;

/// The error of one edge, whitened.
struct EdgeError {
  Eigen::Vector3d measured;
  Matrix3d root_information;

  template <typename T>
  bool operator()(const T* from, const T* to, T* error) const {
    using std::cos;
    using std::sin;
    const T c = cos(from[2]);
    const T s = sin(from[2]);
    const T dx = to[0] - from[0];
    const T dy = to[1] - from[1];
    const T turn = to[2] - from[2] - measured.z();
    const T difference_x = c * dx + s * dy - measured.x();
    const T difference_y = -s * dx + c * dy - measured.y();
    const double mc = std::cos(measured.z());
    const double ms = std::sin(measured.z());
    const Eigen::Matrix<T, 3, 1> difference(
        mc * difference_x + ms * difference_y, -ms * difference_x + mc * difference_y,
        turn - 2.0 * kPi * ceres::floor((turn + kPi) / (2.0 * kPi)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{error} = root_information.cast<T>() * difference;
    return true;
  }
};

/// The text-book start: poses of the file, else along the first edges that reach each vertex.
std::vector<Pose2> start_of(const lab::PoseGraph& graph) {
  if (!graph.T_frame_vertex.empty()) {
    return graph.T_frame_vertex;
  }
  std::vector<Pose2> poses(graph.ids.size());
  std::vector<char> is_known(graph.ids.size(), 0);
  is_known.front() = 1;
  for (const lab::PoseGraphEdge& edge : graph.edges) {
    const auto from = static_cast<std::size_t>(edge.from);
    const auto to = static_cast<std::size_t>(edge.to);
    if (is_known[from] != 0 && is_known[to] == 0) {
      poses[to] = poses[from] * edge.T_from_to;
      is_known[to] = 1;
    }
  }
  return poses;
}

/// The linear start, for Ceres as well; it is not counted in Ceres' time.
std::vector<Pose2> chordal_start_of(const lab::PoseGraph& graph,
                                    std::vector<TravelConstraint> travels) {
  const int place_count = static_cast<int>(graph.ids.size());
  const std::vector<int> number = elimination_order(place_count, travels);
  for (TravelConstraint& travel : travels) {
    travel.from = number[static_cast<std::size_t>(travel.from)];
    travel.to = number[static_cast<std::size_t>(travel.to)];
  }
  const PlaceVector places = linear_start(place_count, travels);
  std::vector<Pose2> poses;
  for (const int position : number) {
    const Eigen::Vector3d& place = places[static_cast<std::size_t>(position)];
    poses.emplace_back(place.x(), place.y(), place.z());
  }
  return poses;
}

struct Outcome {
  double chi2 = 0.0;
  int iterations = 0;
  double time_ms = std::numeric_limits<double>::infinity();
};

Outcome by_ceres(const lab::PoseGraph& graph, std::vector<Pose2> start) {
  const double begin_s = lab::cpu_time_s();
  std::vector<Eigen::Vector3d> poses;
  for (const Pose2& pose : start) {
    poses.emplace_back(pose.x(), pose.y(), pose.theta());
  }
  ceres::Problem problem;
  for (const lab::PoseGraphEdge& edge : graph.edges) {
    const Pose2& measured = edge.T_from_to;
    auto* error = new EdgeError{{measured.x(), measured.y(), measured.theta()},
                                edge.information.llt().matrixU()};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeError, 3, 3, 3>(error), nullptr,
                             poses[static_cast<std::size_t>(edge.from)].data(),
                             poses[static_cast<std::size_t>(edge.to)].data());
  }
  problem.SetParameterBlockConstant(poses.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {2.0 * summary.final_cost, static_cast<int>(summary.iterations.size()),
          1e3 * (lab::cpu_time_s() - begin_s)};
}

Outcome by_cairn(const lab::PoseGraph& graph, const std::vector<TravelConstraint>& travels) {
  const double begin_s = lab::cpu_time_s();
  const Result<LayoutAttempt> attempt = attempt_layout(static_cast<int>(graph.ids.size()), travels);
  const double time_ms = 1e3 * (lab::cpu_time_s() - begin_s);
  if (!attempt || !attempt->is_converged) {
    return {std::numeric_limits<double>::quiet_NaN(), 0, time_ms};
  }
  return {attempt->layout.chi2, attempt->layout.iterations, time_ms};
}

void take_faster(const Outcome& outcome, Outcome* fastest) {
  if (outcome.time_ms < fastest->time_ms) {
    *fastest = outcome;
  }
}

int compare(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  const Result<lab::PoseGraph> graph = lab::parse_pose_graph(content.str());
  if (!graph) {
    std::fprintf(stderr, "%s: %s\n", file.c_str(), graph.error().message.c_str());
    return 1;
  }
  const std::vector<TravelConstraint> travels = travels_of(*graph);
  const std::vector<Pose2> chordal_start = chordal_start_of(*graph, travels);
  Outcome cairn;
  Outcome ceres_file;
  Outcome ceres_chordal;
  for (int i = 0; i < kRepetitions; ++i) {
    take_faster(by_cairn(*graph, travels), &cairn);
    take_faster(by_ceres(*graph, start_of(*graph)), &ceres_file);
    take_faster(by_ceres(*graph, chordal_start), &ceres_chordal);
  }
  std::printf(
      "| %s | %zu / %zu | %.8g | %d | %.2f | %.8g | %d | %.2f | %.1f | %.8g | %d | %.2f | %.1f |\n",
      file.substr(file.find_last_of('/') + 1).c_str(), graph->ids.size(), graph->edges.size(),
      cairn.chi2, cairn.iterations, cairn.time_ms, ceres_file.chi2, ceres_file.iterations,
      ceres_file.time_ms, ceres_file.time_ms / cairn.time_ms, ceres_chordal.chi2,
      ceres_chordal.iterations, ceres_chordal.time_ms, ceres_chordal.time_ms / cairn.time_ms);
  return 0;
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  std::printf(
      "| graph | V / E | cairn chi2 | steps | ms | Ceres chi2, file's start | steps | ms | "
      "ratio | Ceres chi2, chordal start | steps | ms | ratio |\n");
  int status = 0;
  for (int i = 1; i < argc; ++i) {
    status |= cairn::compare(argv[i]);
  }
  return status;
}
