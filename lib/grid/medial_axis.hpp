#pragma once

#include <cstddef>
#include <vector>

#include "base/result.hpp"
#include "grid/distance_transform.hpp"

namespace cairn {

struct MedialAxisOptions {
  double min_clearance_m = 0.25;     ///< Free space narrower than twice this is no passage. >= 0
  double coastal_distance_m = 1.0;   ///< Blind branches less deep than this are spurs. >= 0
  double min_basis_angle_rad = 2.1;  ///< Between basis points seen from the axis. (0, pi)
  friend bool operator==(const MedialAxisOptions&, const MedialAxisOptions&) = default;
};

[[nodiscard]] Status validate(const MedialAxisOptions& options);

/// What lies where an edge of the axis does not meet another one.
enum class AxisEnd {
  kMeets,    ///< Not an end: edges meet here.
  kBlocked,  ///< Walls all around.
  kUnknown,  ///< Free space goes on into cells of unknown state.
  kBorder,   ///< Free space goes on beyond the window.
};

/// A point where edges of the axis meet, or where one ends.
struct AxisNode {
  Cell cell;
  double clearance_m = 0.0;
  AxisEnd end = AxisEnd::kMeets;
  std::vector<std::size_t> edges;  ///< Ascending; an edge from the node to itself is listed twice.
};

/// A chain of cells of the axis from one node to another, both included.
struct AxisEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  std::vector<Cell> cells;          ///< 8-connected, cells of both nodes included.
  std::vector<double> clearance_m;  ///< As many.
};

/// The thinned medial axis (Voronoi diagram) of the free space that can be reached from one cell.
struct MedialAxis {
  std::vector<AxisNode> nodes;
  std::vector<AxisEdge> edges;
};

/// The medial axis of the connected piece of passable free space around `start`, usually the
/// robot's cell. Where `start` itself is too narrow, the nearest passable cell within 0.5 m counts.
/// Empty where there is none.
///
/// Cells whose basis points lie far apart as seen from the cell are kept, all others are removed in
/// the order of their clearance as long as the free space keeps its topology; so wall noise raises
/// no branches. Blind branches that reach less than the coastal distance beyond the clearance disc
/// of the point they leave from are pruned, unless they lead to the border of the window.
///
/// Source: Kuipers et al., ICRA 2004, Fig. 3(a); coastal distance and the choice of the robot's own
/// component as in Beeson, Jong and Kuipers' EVG-THIN (ICRA 2005).
/// Cost: sorting the cells of the window, and a few passes over them.
[[nodiscard]] MedialAxis medial_axis(const DistanceTransform& distances,
                                     Cell start,
                                     const MedialAxisOptions& options);

}  // namespace cairn
