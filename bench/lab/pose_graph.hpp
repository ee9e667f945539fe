#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "geometry/pose2.hpp"
#include "layout/place_layout.hpp"

namespace cairn::lab {

/// A measured pose of one vertex in the frame of another.
struct PoseGraphEdge {
  int from = 0;  ///< Number of the vertex, not its id.
  int to = 0;
  Pose2 T_from_to;
  /// Of (x, y, theta) of T_measured_to, the difference of what is and what was measured, in the
  /// frame of the measured pose: as g2o weighs it.
  Matrix3d information = Matrix3d::Identity();
};

/// A pose graph as a file has it. Vertices are numbered in the order of their lines; where there
/// are no such lines, by their ids.
struct PoseGraph {
  std::vector<int> ids;               ///< By vertex.
  std::vector<Pose2> T_frame_vertex;  ///< By vertex, as in the file; empty where it has none.
  std::vector<PoseGraphEdge> edges;   ///< In the order of the file.
  int anchor = 0;                     ///< The vertex whose pose is kept: that of FIX, or the first.
  bool has_fixed_vertex = false;      ///< Whether the file says so.
  int parallel_edges = 0;             ///< Edges between vertices that an earlier edge joins.
};

/// Reads the 2D pose graphs of g2o (VERTEX_SE2, EDGE_SE2, FIX) and TORO (VERTEX2, EDGE2, whose
/// information stands in the order xx xy yy tt xt yt). Blank lines and lines that begin with '#'
/// are skipped. Several edges between two vertices are several measurements, and all count; the
/// very same one twice is an error.
///
/// Errors, kMalformed or kInvalidValue, say on which line what was expected and what came: other
/// elements, words too few or too many, what is no number or not finite, ids that are negative,
/// repeated or of no vertex (where the file has vertices), edges from a vertex to itself
/// or written twice,
/// information that is not positive definite, a second fixed vertex, a graph in several pieces, and
/// a file with nothing in it.
[[nodiscard]] Result<PoseGraph> parse_pose_graph(std::string_view text);

/// As g2o: all vertices with these poses, what is fixed, and the edges.
/// @pre one pose for every vertex
[[nodiscard]] std::string to_g2o(const PoseGraph& graph, const std::vector<Pose2>& T_frame_vertex);

/// The sum of e' Omega e over all edges, e as g2o has it: (x, y, theta) of T_measured_to.
/// @pre one pose for every vertex
[[nodiscard]] double chi2_of(const PoseGraph& graph, const std::vector<Pose2>& T_frame_vertex);

/// The edges as the layout takes them, of the same chi2: information becomes covariance, and is
/// turned to the frame of departure.
[[nodiscard]] std::vector<TravelConstraint> travels_of(const PoseGraph& graph);

}  // namespace cairn::lab
