#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/axis_graph.hpp"

namespace cairn {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr double kNoSpur = std::numeric_limits<double>::infinity();

bool is_at_border(const GridWindow& window, Cell c) {
  return c.x == window.lower.x || c.y == window.lower.y ||
         c.x == window.lower.x + window.width - 1 || c.y == window.lower.y + window.height - 1;
}

bool is_beside_unknown(const DistanceTransform& distances, Cell c) {
  return distances.state({c.x + 1, c.y}) == CellState::kUnknown ||
         distances.state({c.x - 1, c.y}) == CellState::kUnknown ||
         distances.state({c.x, c.y + 1}) == CellState::kUnknown ||
         distances.state({c.x, c.y - 1}) == CellState::kUnknown;
}

/// Whether cells of unknown state lie right behind the free cells around the end of an axis. A wall
/// of one cell hides what is unknown behind it, so free cells beside unknown ones are counted.
bool touches_unknown(const DistanceTransform& distances, Cell end) {
  constexpr int kLeastFrontierCells = 3;
  const GridWindow& window = distances.window();
  const double reach = distances.clearance_m(end) / distances.geometry().cell_m + 1.5;
  const int r = static_cast<int>(std::min(reach, 1000.0));
  const int first_x = std::max(end.x - r, window.lower.x);
  const int last_x = std::min(end.x + r, window.lower.x + window.width - 1);
  const int last_y = std::min(end.y + r, window.lower.y + window.height - 1);
  int frontier = 0;
  for (int y = std::max(end.y - r, window.lower.y); y <= last_y; ++y) {
    const int dy = y - end.y;
    const std::int32_t* const squared = distances.squared_clearances_cells().data() +
                                        std::ptrdiff_t{y - window.lower.y} * window.width -
                                        window.lower.x;
    for (int x = first_x; x <= last_x; ++x) {
      const int dx = x - end.x;
      const std::int32_t here = squared[x - window.lower.x];
      if (here == 0 || dx * dx + dy * dy > reach * reach) {
        continue;
      }
      // Only beside a cell that is not free there can be an unknown one, or beyond the border.
      const bool may_be = here == 1 || is_at_border(window, {x, y});
      frontier += may_be && is_beside_unknown(distances, {x, y}) ? 1 : 0;
      if (frontier >= kLeastFrontierCells) {
        return true;
      }
    }
  }
  return false;
}

bool is_end_at_border(const GridWindow& w, Cell end) {
  constexpr int kNearBorder = 2;
  const int to_border =
      std::min({end.x - w.lower.x, end.y - w.lower.y, w.lower.x + w.width - 1 - end.x,
                w.lower.y + w.height - 1 - end.y});
  return to_border <= kNearBorder;
}

AxisEnd kind_of_end(const DistanceTransform& distances, Cell end) {
  if (is_end_at_border(distances.window(), end)) {
    return AxisEnd::kBorder;
  }
  return touches_unknown(distances, end) ? AxisEnd::kUnknown : AxisEnd::kBlocked;
}

class AxisPruner {
 public:
  AxisPruner(MedialAxis axis, double coastal_distance_m, const DistanceTransform& distances)
      : axis_(std::move(axis)),
        coastal_distance_m_(coastal_distance_m),
        distances_(distances),
        is_gone_(axis_.edges.size(), false),
        depth_m_(axis_.edges.size(), kNoSpur) {}

  MedialAxis prune() {
    for (std::size_t e = 0; e < axis_.edges.size(); ++e) {
      note_depth(e);
    }
    for (std::size_t n = 0; n < axis_.nodes.size(); ++n) {
      join_at(n);
    }
    for (std::size_t edge = shallowest_spur(); edge != kNone; edge = shallowest_spur()) {
      remove(edge);
    }
    return compacted();
  }

 private:
  /// The node a blind branch leaves from, or none.
  [[nodiscard]] std::size_t base_of(const AxisEdge& edge) const {
    const std::size_t from_degree = axis_.nodes[edge.from].edges.size();
    const std::size_t to_degree = axis_.nodes[edge.to].edges.size();
    if (from_degree == 1 && to_degree > 2) {
      return edge.to;
    }
    return to_degree == 1 && from_degree > 2 ? edge.from : kNone;
  }

  /// How far a blind branch reaches beyond the clearance disc of the node it leaves from.
  void note_depth(std::size_t e) {
    const AxisEdge& edge = axis_.edges[e];
    const std::size_t base = base_of(edge);
    depth_m_[e] = kNoSpur;
    if (base == kNone) {
      return;
    }
    const AxisNode& tip = axis_.nodes[base == edge.from ? edge.to : edge.from];
    if (!is_end_at_border(distances_.window(), tip.cell)) {
      depth_m_[e] = length_m(edge, 0, edge.cells.size() - 1, distances_.geometry().cell_m) +
                    tip.clearance_m - axis_.nodes[base].clearance_m;
    }
  }

  [[nodiscard]] std::size_t shallowest_spur() const {
    const auto least = std::min_element(depth_m_.begin(), depth_m_.end());
    return least != depth_m_.end() && *least < coastal_distance_m_
               ? static_cast<std::size_t>(least - depth_m_.begin())
               : kNone;
  }

  void remove(std::size_t e) {
    const AxisEdge& edge = axis_.edges[e];
    const std::size_t base = base_of(edge);
    detach(e, edge.from);
    detach(e, edge.to);
    take_out(e);
    join_at(base);
  }

  void take_out(std::size_t e) {
    is_gone_[e] = true;
    depth_m_[e] = kNoSpur;
  }

  void detach(std::size_t e, std::size_t n) {
    std::vector<std::size_t>& edges = axis_.nodes[n].edges;
    edges.erase(std::find(edges.begin(), edges.end(), e));
  }

  static void reverse(AxisEdge* edge) {
    std::swap(edge->from, edge->to);
    std::reverse(edge->cells.begin(), edge->cells.end());
    std::reverse(edge->clearance_m.begin(), edge->clearance_m.end());
  }

  /// Makes one edge of the two of a node that has just two.
  void join_at(std::size_t n) {
    if (axis_.nodes[n].edges.size() != 2 || axis_.nodes[n].edges[0] == axis_.nodes[n].edges[1]) {
      return;
    }
    const std::size_t kept = axis_.nodes[n].edges[0];
    const std::size_t merged = axis_.nodes[n].edges[1];
    AxisEdge& first = axis_.edges[kept];
    AxisEdge& second = axis_.edges[merged];
    if (first.to != n) {
      reverse(&first);
    }
    if (second.from != n) {
      reverse(&second);
    }
    first.to = second.to;
    first.cells.insert(first.cells.end(), second.cells.begin() + 1, second.cells.end());
    first.clearance_m.insert(first.clearance_m.end(), second.clearance_m.begin() + 1,
                             second.clearance_m.end());
    std::vector<std::size_t>& at_far_end = axis_.nodes[second.to].edges;
    std::replace(at_far_end.begin(), at_far_end.end(), merged, kept);
    std::sort(at_far_end.begin(), at_far_end.end());
    axis_.nodes[n].edges.clear();
    take_out(merged);
    note_depth(kept);
  }

  /// The nodes and edges that are left, numbered anew.
  MedialAxis compacted() {
    MedialAxis result;
    std::vector<std::size_t> number(axis_.nodes.size(), kNone);
    const bool is_point =
        std::all_of(is_gone_.begin(), is_gone_.end(), [](bool gone) { return gone; });
    for (std::size_t n = 0; n < axis_.nodes.size(); ++n) {
      AxisNode& node = axis_.nodes[n];
      if (node.edges.empty() && !(is_point && result.nodes.empty())) {
        continue;
      }
      if (node.edges.size() < 2) {
        node.end = kind_of_end(distances_, node.cell);
      }
      number[n] = result.nodes.size();
      result.nodes.push_back(node);
      result.nodes.back().edges.clear();
    }
    for (std::size_t e = 0; e < axis_.edges.size(); ++e) {
      if (is_gone_[e]) {
        continue;
      }
      AxisEdge edge = std::move(axis_.edges[e]);
      edge.from = number[edge.from];
      edge.to = number[edge.to];
      result.nodes[edge.from].edges.push_back(result.edges.size());
      result.nodes[edge.to].edges.push_back(result.edges.size());
      result.edges.push_back(std::move(edge));
    }
    return result;
  }

  MedialAxis axis_;
  double coastal_distance_m_;
  const DistanceTransform& distances_;
  std::vector<bool> is_gone_;
  std::vector<double> depth_m_;  ///< By edge; kNoSpur where it may not be pruned.
};

}  // namespace

MedialAxis pruned(MedialAxis axis, double coastal_distance_m, const DistanceTransform& distances) {
  return AxisPruner(std::move(axis), coastal_distance_m, distances).prune();
}

}  // namespace cairn
