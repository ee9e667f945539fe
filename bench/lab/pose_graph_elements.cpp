#include "bench/lab/pose_graph_elements.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Eigenvalues>

namespace cairn::lab {
namespace {

/// Below this share of the greatest eigenvalue the least one is rounding.
constexpr double kLeastShare = 1e-13;
constexpr std::size_t kVertexWords = 5;
constexpr std::size_t kEdgeWords = 12;
constexpr std::array<const char*, 3> kPoseNames = {"x", "y", "theta"};

Result<Pose2> pose_at(const TextLine& line, std::size_t first) {
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Result<double> number = line.number_at(first + i, kPoseNames.at(i));
    if (!number) {
      return number.error();
    }
    numbers.at(i) = *number;
  }
  return Pose2(numbers[0], numbers[1], numbers[2]);
}

/// Where the six numbers of an upper triangle stand, row and column.
using TriangleOrder = std::array<std::pair<int, int>, 6>;
constexpr TriangleOrder kG2oOrder = {{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
constexpr TriangleOrder kToroOrder = {{{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}}};

Status require_positive_definite(const TextLine& line, const Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(information, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d eigenvalues = solver.eigenvalues();
  const bool is_definite = solver.info() == Eigen::Success && eigenvalues.allFinite() &&
                           eigenvalues[0] > kLeastShare * eigenvalues[2];
  if (!is_definite) {
    return line.error("a positive definite information matrix",
                      "eigenvalues " + exact(eigenvalues[0]) + ", " + exact(eigenvalues[1]) + ", " +
                          exact(eigenvalues[2]));
  }
  return {};
}

Result<Matrix3d> information_at(const TextLine& line, const TriangleOrder& order) {
  Matrix3d information;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Result<double> number = line.number_at(kEdgeWords - order.size() + i, "the information");
    if (!number) {
      return number.error();
    }
    const auto [row, column] = order.at(i);
    information(row, column) = information(column, row) = *number;
  }
  if (const Status sound = require_positive_definite(line, information); !sound) {
    return sound.error();
  }
  return information;
}

Status require_words(const TextLine& line, std::size_t count, const char* form) {
  if (line.words.size() != count) {
    return line.error(
        "'" + std::string(line.words.front()) + form + "', " + std::to_string(count) + " words",
        std::to_string(line.words.size()));
  }
  return {};
}

Status read_vertex(const TextLine& line, PoseGraphElements* elements) {
  if (const Status sound = require_words(line, kVertexWords, " id x y theta"); !sound) {
    return sound;
  }
  const Result<int> id = line.id(1);
  if (!id) {
    return id.error();
  }
  const Result<Pose2> pose = pose_at(line, 2);
  if (!pose) {
    return pose.error();
  }
  elements->vertices.push_back({line.number, *id, *id, *pose, Matrix3d::Identity()});
  return {};
}

Status read_edge(const TextLine& line, bool is_toro, PoseGraphElements* elements) {
  const char* const form =
      is_toro ? " from to x y theta xx xy yy tt xt yt" : " from to x y theta xx xy xt yy yt tt";
  if (const Status sound = require_words(line, kEdgeWords, form); !sound) {
    return sound;
  }
  const Result<int> from = line.id(1);
  if (!from) {
    return from.error();
  }
  const Result<int> to = line.id(2);
  if (!to) {
    return to.error();
  }
  if (*from == *to) {
    return line.error("an edge between two vertices",
                      "one from " + std::to_string(*from) + " to itself");
  }
  const Result<Pose2> pose = pose_at(line, 3);
  if (!pose) {
    return pose.error();
  }
  const Result<Matrix3d> information = information_at(line, is_toro ? kToroOrder : kG2oOrder);
  if (!information) {
    return information.error();
  }
  elements->edges.push_back({line.number, *from, *to, *pose, *information});
  return {};
}

Status read_fixed(const TextLine& line, PoseGraphElements* elements) {
  if (const Status sound = require_words(line, 2, " id"); !sound) {
    return sound;
  }
  if (elements->fixed) {
    return line.error("one fixed vertex (line " + std::to_string(elements->fixed->line) + ")",
                      "a second one, " + std::string(line.words[1]));
  }
  const Result<int> id = line.id(1);
  if (!id) {
    return id.error();
  }
  elements->fixed = PoseGraphElement{line.number, *id, *id, {}, Matrix3d::Identity()};
  return {};
}

}  // namespace

Status read_element(const TextLine& line, PoseGraphElements* elements) {
  const std::string_view tag = line.words.front();
  if (tag == "VERTEX_SE2" || tag == "VERTEX2") {
    return read_vertex(line, elements);
  }
  if (tag == "EDGE_SE2" || tag == "EDGE2") {
    return read_edge(line, tag == "EDGE2", elements);
  }
  if (tag == "FIX") {
    return read_fixed(line, elements);
  }
  return line.error("VERTEX_SE2, EDGE_SE2, FIX (g2o), VERTEX2 or EDGE2 (TORO)", tag);
}

}  // namespace cairn::lab
