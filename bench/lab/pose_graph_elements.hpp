#pragma once

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "bench/lab/pose_graph_text.hpp"
#include "geometry/pose2.hpp"

namespace cairn::lab {

/// An element of the file as it stands there.
struct PoseGraphElement {
  int line = 0;
  int from = 0;  ///< An id, as is `to`.
  int to = 0;
  Pose2 pose;
  Matrix3d information = Matrix3d::Identity();
};

/// The lines of a pose graph, before they are held against each other.
struct PoseGraphElements {
  std::vector<PoseGraphElement> vertices;
  std::vector<PoseGraphElement> edges;
  std::optional<PoseGraphElement> fixed;
};

/// Reads one line of a g2o or TORO file, as `parse_pose_graph` says.
[[nodiscard]] Status read_element(const TextLine& line, PoseGraphElements* elements);

}  // namespace cairn::lab
