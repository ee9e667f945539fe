#include "bench/lab/pose_graph.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "bench/lab/pose_graph_elements.hpp"
#include "bench/lab/pose_graph_text.hpp"
#include "layout/displacement.hpp"

namespace cairn::lab {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Error on_line(int line, const std::string& message) {
  return {ErrorCode::kInvalidValue, "line " + std::to_string(line) + ": " + message};
}

TravelConstraint travel_of(const PoseGraphEdge& edge) {
  Matrix3d rotation = Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(edge.T_from_to.theta()).toRotationMatrix();
  const Matrix3d covariance = rotation * edge.information.inverse() * rotation.transpose();
  return {edge.from, edge.to, {edge.T_from_to, 0.5 * (covariance + covariance.transpose())}};
}

/// Numbers of vertices by id, and the line each is from.
using VertexNumbers = std::unordered_map<int, std::pair<int, int>>;

Status number_vertices(const PoseGraphElements& elements,
                       PoseGraph* graph,
                       VertexNumbers* numbers) {
  for (const PoseGraphElement& vertex : elements.vertices) {
    const auto [known, is_new] =
        numbers->try_emplace(vertex.from, static_cast<int>(graph->ids.size()), vertex.line);
    if (!is_new) {
      return on_line(vertex.line, "expected a vertex of its own, got id " +
                                      std::to_string(vertex.from) + " again (line " +
                                      std::to_string(known->second.second) + ")");
    }
    graph->ids.push_back(vertex.from);
    graph->T_frame_vertex.push_back(vertex.pose);
  }
  if (elements.vertices.empty()) {
    std::set<int> ids;
    for (const PoseGraphElement& edge : elements.edges) {
      ids.insert({edge.from, edge.to});
    }
    for (const int id : ids) {
      numbers->try_emplace(id, static_cast<int>(graph->ids.size()), 0);
      graph->ids.push_back(id);
    }
  }
  return {};
}

Result<int> vertex_of(int id, int line, const VertexNumbers& numbers) {
  const auto found = numbers.find(id);
  if (found == numbers.end()) {
    return on_line(line, "expected the id of a vertex of the file, got " + std::to_string(id));
  }
  return found->second.first;
}

/// Two measurements never agree to the last digit: the edge was written twice.
struct IsSameEdge {
  const PoseGraphElement& edge;

  bool operator()(const PoseGraphElement* other) const {
    return other->from == edge.from && other->to == edge.to && other->pose == edge.pose &&
           other->information == edge.information;
  }
};

Status take_edges(const PoseGraphElements& elements,
                  const VertexNumbers& numbers,
                  PoseGraph* graph) {
  std::map<std::pair<int, int>, std::vector<const PoseGraphElement*>> joined;
  for (const PoseGraphElement& edge : elements.edges) {
    const Result<int> from = vertex_of(edge.from, edge.line, numbers);
    if (!from) {
      return from.error();
    }
    const Result<int> to = vertex_of(edge.to, edge.line, numbers);
    if (!to) {
      return to.error();
    }
    std::vector<const PoseGraphElement*>& others = joined[std::minmax(*from, *to)];
    if (const auto same = std::find_if(others.begin(), others.end(), IsSameEdge{edge});
        same != others.end()) {
      return on_line(edge.line, "expected an edge of its own, got that of line " +
                                    std::to_string((*same)->line) + " again");
    }
    graph->parallel_edges += others.empty() ? 0 : 1;
    others.push_back(&edge);
    graph->edges.push_back({*from, *to, edge.pose, edge.information});
    if (const Status sound = validate_displacement(travel_of(graph->edges.back()).T_from_to);
        !sound) {
      return on_line(edge.line, "the inverse of the information: " + sound.error().message);
    }
  }
  if (elements.fixed) {
    const Result<int> anchor = vertex_of(elements.fixed->from, elements.fixed->line, numbers);
    if (!anchor) {
      return anchor.error();
    }
    graph->anchor = *anchor;
    graph->has_fixed_vertex = true;
  }
  return {};
}

/// By vertex, the lowest vertex of its piece.
std::vector<int> pieces_of(const PoseGraph& graph) {
  std::vector<int> piece(graph.ids.size());
  std::iota(piece.begin(), piece.end(), 0);
  const auto root_of = [&](int vertex) {
    while (piece[at(vertex)] != vertex) {
      piece[at(vertex)] = piece[at(piece[at(vertex)])];
      vertex = piece[at(vertex)];
    }
    return vertex;
  };
  for (const PoseGraphEdge& edge : graph.edges) {
    const auto [low, high] = std::minmax({root_of(edge.from), root_of(edge.to)});
    piece[at(high)] = low;
  }
  for (int vertex = 0; vertex < static_cast<int>(piece.size()); ++vertex) {
    piece[at(vertex)] = root_of(vertex);
  }
  return piece;
}

Status require_one_piece(const PoseGraph& graph) {
  const std::vector<int> piece = pieces_of(graph);
  const std::set<int> pieces(piece.begin(), piece.end());
  if (pieces.size() > 1) {
    return Error{ErrorCode::kInvalidValue,
                 "expected a graph in one piece, got " + std::to_string(pieces.size()) +
                     " pieces: no edges lead from vertex " + std::to_string(graph.ids.front()) +
                     " to vertex " + std::to_string(graph.ids[at(*std::next(pieces.begin()))])};
  }
  return {};
}

}  // namespace

Result<PoseGraph> parse_pose_graph(std::string_view text) {
  PoseGraphElements elements;
  for (const TextLine& line : text_lines(text)) {
    if (const Status sound = read_element(line, &elements); !sound) {
      return sound.error();
    }
  }
  if (elements.vertices.empty() && elements.edges.empty()) {
    return Error{ErrorCode::kMalformed,
                 "line 1: expected vertices or edges of a pose graph, got none in the whole file"};
  }
  PoseGraph graph;
  VertexNumbers numbers;
  if (const Status sound = number_vertices(elements, &graph, &numbers); !sound) {
    return sound.error();
  }
  if (const Status sound = take_edges(elements, numbers, &graph); !sound) {
    return sound.error();
  }
  if (const Status sound = require_one_piece(graph); !sound) {
    return sound.error();
  }
  return graph;
}

std::string to_g2o(const PoseGraph& graph, const std::vector<Pose2>& T_frame_vertex) {
  std::string text;
  const auto add_pose = [&](const Pose2& pose) {
    text += ' ' + exact(pose.x()) + ' ' + exact(pose.y()) + ' ' + exact(pose.theta());
  };
  for (std::size_t vertex = 0; vertex < graph.ids.size(); ++vertex) {
    text += "VERTEX_SE2 " + std::to_string(graph.ids[vertex]);
    add_pose(T_frame_vertex[vertex]);
    text += '\n';
  }
  if (graph.has_fixed_vertex) {
    text += "FIX " + std::to_string(graph.ids[at(graph.anchor)]) + '\n';
  }
  for (const PoseGraphEdge& edge : graph.edges) {
    text += "EDGE_SE2 " + std::to_string(graph.ids[at(edge.from)]) + ' ' +
            std::to_string(graph.ids[at(edge.to)]);
    add_pose(edge.T_from_to);
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) {
        text += ' ' + exact(edge.information(row, column));
      }
    }
    text += '\n';
  }
  return text;
}

double chi2_of(const PoseGraph& graph, const std::vector<Pose2>& T_frame_vertex) {
  double chi2 = 0.0;
  for (const PoseGraphEdge& edge : graph.edges) {
    const Pose2 T_measured_to =
        edge.T_from_to.inverse() *
        (T_frame_vertex[at(edge.from)].inverse() * T_frame_vertex[at(edge.to)]);
    const Eigen::Vector3d error(T_measured_to.x(), T_measured_to.y(), T_measured_to.theta());
    chi2 += error.dot(edge.information * error);
  }
  return chi2;
}

std::vector<TravelConstraint> travels_of(const PoseGraph& graph) {
  std::vector<TravelConstraint> travels;
  travels.reserve(graph.edges.size());
  for (const PoseGraphEdge& edge : graph.edges) {
    travels.push_back(travel_of(edge));
  }
  return travels;
}

}  // namespace cairn::lab
