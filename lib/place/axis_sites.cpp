#include "place/axis_sites.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/angle.hpp"
#include "grid/axis_graph.hpp"

namespace cairn {
namespace {

/// Clearance outside of the node's disc is only looked at from this share of its radius on: the
/// corners of a junction often lie a little inside.
constexpr double kShareOfDisc = 0.8;
/// A passage narrower than this share of the space on both sides is a doorway.
constexpr double kDoorwayShare = 0.6;

std::vector<double> steps_of(const AxisEdge& edge, double cell_m) {
  std::vector<double> steps;
  steps.reserve(edge.cells.size());
  for (std::size_t i = 0; i + 1 < edge.cells.size(); ++i) {
    steps.push_back(cell_m * step_cells(edge.cells[i], edge.cells[i + 1]));
  }
  return steps;
}

/// The position that lies `reach_m` along the edge from another one, or its end.
std::size_t position_after(const std::vector<double>& step_m,
                           std::size_t i,
                           bool forward,
                           double reach_m) {
  double travelled_m = 0.0;
  while (travelled_m < reach_m && (forward ? i < step_m.size() : i > 0)) {
    travelled_m += step_m[forward ? i : i - 1];
    i = forward ? i + 1 : i - 1;
  }
  return i;
}

/// Looks for the corners of an edge.
class CornerFinder {
 public:
  CornerFinder(const AxisEdge& edge, double cell_m, double min_turn_rad)
      : edge_(edge),
        cell_m_(cell_m),
        min_turn_rad_(min_turn_rad),
        plain_cosine_(std::cos(min_turn_rad) + 1e-6),
        step_m_(steps_of(edge, cell_m)) {}

  /// Positions where the edge turns most, in ascending order; at most one within the reach of
  /// another.
  [[nodiscard]] std::vector<std::size_t> corners() const {
    std::vector<double> turns(edge_.cells.size());
    for (std::size_t i = 0; i < turns.size(); ++i) {
      turns[i] = turn_at(i);
    }
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (turns[i] < min_turn_rad_) {
        continue;
      }
      const double reach_m = reach_at(i);
      const std::size_t a = position_after(step_m_, i, false, reach_m);
      const std::size_t b = position_after(step_m_, i, true, reach_m);
      const auto first = turns.begin() + static_cast<std::ptrdiff_t>(a);
      const auto last = turns.begin() + static_cast<std::ptrdiff_t>(b) + 1;
      const auto most = std::max_element(first, last);
      if (static_cast<std::size_t>(most - turns.begin()) == i) {
        corners.push_back(i);
      }
    }
    return corners;
  }

 private:
  [[nodiscard]] double reach_at(std::size_t i) const { return 1.0 + edge_.clearance_m[i]; }

  /// How far the axis turns around a position, seen over a reach that grows with the passage's
  /// width; 0 where that is plainly less than what makes a corner.
  [[nodiscard]] double turn_at(std::size_t i) const {
    const double reach_m = reach_at(i);
    const std::size_t back = position_after(step_m_, i, false, reach_m);
    const std::size_t ahead = position_after(step_m_, i, true, reach_m);
    // What does not come to an end of the edge is as long as the reach.
    if ((back == 0 && length_m(edge_, back, i, cell_m_) < 0.5 * reach_m) ||
        (ahead + 1 == edge_.cells.size() && length_m(edge_, i, ahead, cell_m_) < 0.5 * reach_m)) {
      return 0.0;
    }
    const auto way = [&](std::size_t a, std::size_t b) {
      return Vector2d(edge_.cells[b].x - edge_.cells[a].x, edge_.cells[b].y - edge_.cells[a].y);
    };
    const Vector2d before = way(back, i);
    const Vector2d behind = way(i, ahead);
    if (before.dot(behind) >
        plain_cosine_ * std::sqrt(before.squaredNorm() * behind.squaredNorm())) {
      return 0.0;
    }
    return std::abs(
        turn_between(std::atan2(before.y(), before.x()), std::atan2(behind.y(), behind.x())));
  }

  const AxisEdge& edge_;
  double cell_m_;
  double min_turn_rad_;
  double plain_cosine_;  ///< Ways closer in direction are no corner, whatever the rounding.
  std::vector<double> step_m_;
};

AxisEdge part_of(const AxisEdge& edge, std::size_t first, std::size_t last) {
  const auto a = static_cast<std::ptrdiff_t>(first);
  const auto b = static_cast<std::ptrdiff_t>(last) + 1;
  return {0,
          0,
          {edge.cells.begin() + a, edge.cells.begin() + b},
          {edge.clearance_m.begin() + a, edge.clearance_m.begin() + b}};
}

bool is_site_node(const AxisNode& node) {
  return node.edges.size() >= 2 || (node.edges.size() == 1 && node.end == AxisEnd::kBlocked);
}

/// Representative of a node's group; groups are trees of parents.
std::size_t root_of(std::vector<std::size_t>* parent, std::size_t n) {
  while ((*parent)[n] != n) {
    (*parent)[n] = (*parent)[(*parent)[n]];
    n = (*parent)[n];
  }
  return n;
}

bool has_doorway(const MedialAxis& axis, const AxisEdge& edge) {
  const double least_m = *std::min_element(edge.clearance_m.begin(), edge.clearance_m.end());
  return least_m < kDoorwayShare *
                       std::min(axis.nodes[edge.from].clearance_m, axis.nodes[edge.to].clearance_m);
}

/// Whether the places at both ends of an edge cannot be told apart.
bool joins_its_ends(const LocalView& view, std::size_t e, const PlaceOptions& options) {
  const AxisEdge& edge = view.axis.edges[e];
  if (!is_site_node(view.axis.nodes[edge.from]) || !is_site_node(view.axis.nodes[edge.to])) {
    return false;
  }
  if (has_doorway(view.axis, edge)) {
    return false;
  }
  const auto from = first_constriction(view, {e, true}, options);
  const auto to = first_constriction(view, {e, false}, options);
  return !from || !to || *from + *to >= edge.cells.size() - 1;
}

/// What bounds the axis around one of its cells.
struct Sides {
  int walls = 0;
  int unknown = 0;
};

/// Looks at the basis points of the cell and of those beside it, which lie on either side of the
/// axis.
Sides sides_of(const LocalView& view, Cell cell) {
  const GridGeometry& geometry = view.grid.geometry();
  const CellState* const states = view.distances.states().data();
  const CellOffset* const to_basis = view.distances.basis_offsets().data();
  Sides sides;
  for (int y = std::max(cell.y - 1, 0); y <= std::min(cell.y + 1, geometry.height - 1); ++y) {
    for (int x = std::max(cell.x - 1, 0); x <= std::min(cell.x + 1, geometry.width - 1); ++x) {
      const std::size_t at = geometry.index_of({x, y});
      if (states[at] == CellState::kFree) {
        const Cell basis{x + to_basis[at].dx, y + to_basis[at].dy};
        const bool is_wall = view.is_wall[geometry.index_of(basis)] != 0;
        ++(is_wall ? sides.walls : sides.unknown);
      }
    }
  }
  return sides;
}

/// The least clearance between walls on the stretch ahead of a position, the position included.
double least_ahead_m(const LocalView& view, AxisWay way, std::size_t position, double stretch_m) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const EdgeProfile& profile = view.profiles[way.edge];
  std::size_t at = index_on_edge(view.axis, way, position);
  double least_m = edge.clearance_m[at];
  double ahead_m = 0.0;
  for (std::size_t i = position; i + 1 < edge.cells.size() && ahead_m < stretch_m; ++i) {
    ahead_m += profile.step_m[way.forward ? at : at - 1];
    at = way.forward ? at + 1 : at - 1;
    if (profile.is_between_walls[at] != 0) {
      least_m = std::min(least_m, edge.clearance_m[at]);
    }
  }
  return least_m;
}

}  // namespace

std::size_t index_on_edge(const MedialAxis& axis, AxisWay way, std::size_t position) {
  return way.forward ? position : axis.edges[way.edge].cells.size() - 1 - position;
}

MedialAxis with_corner_nodes(const MedialAxis& axis, double cell_m, double min_turn_rad) {
  MedialAxis result;
  result.nodes = axis.nodes;
  for (AxisNode& node : result.nodes) {
    node.edges.clear();
  }
  const auto add = [&result](AxisEdge edge, std::size_t from, std::size_t to) {
    edge.from = from;
    edge.to = to;
    result.nodes[from].edges.push_back(result.edges.size());
    result.nodes[to].edges.push_back(result.edges.size());
    result.edges.push_back(std::move(edge));
  };
  for (const AxisEdge& edge : axis.edges) {
    std::size_t start = 0;
    std::size_t from = edge.from;
    for (const std::size_t corner : CornerFinder(edge, cell_m, min_turn_rad).corners()) {
      const std::size_t node = result.nodes.size();
      result.nodes.push_back({edge.cells[corner], edge.clearance_m[corner], AxisEnd::kMeets, {}});
      add(part_of(edge, start, corner), from, node);
      start = corner;
      from = node;
    }
    add(part_of(edge, start, edge.cells.size() - 1), from, edge.to);
  }
  return result;
}

std::vector<EdgeProfile> edge_profiles(const LocalView& view) {
  std::vector<EdgeProfile> profiles;
  profiles.reserve(view.axis.edges.size());
  for (const AxisEdge& edge : view.axis.edges) {
    EdgeProfile profile;
    profile.step_m = steps_of(edge, view.grid.geometry().cell_m);
    profile.is_along_wall.reserve(edge.cells.size());
    profile.is_between_walls.reserve(edge.cells.size());
    for (const Cell cell : edge.cells) {
      const Sides sides = sides_of(view, cell);
      profile.is_along_wall.push_back(sides.walls > 0 ? 1 : 0);
      profile.is_between_walls.push_back(sides.unknown == 0 ? 1 : 0);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

bool is_along_wall(const LocalView& view, AxisWay way, std::size_t position) {
  return view.profiles[way.edge].is_along_wall[index_on_edge(view.axis, way, position)] != 0;
}

bool is_between_walls(const LocalView& view, AxisWay way, std::size_t position) {
  return view.profiles[way.edge].is_between_walls[index_on_edge(view.axis, way, position)] != 0;
}

std::optional<std::size_t> first_constriction(const LocalView& view,
                                              AxisWay way,
                                              const PlaceOptions& options) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const EdgeProfile& profile = view.profiles[way.edge];
  const auto index = [&](std::size_t i) { return index_on_edge(view.axis, way, i); };
  const double start_m = kShareOfDisc * edge.clearance_m[index(0)];
  double travelled_m = 0.0;
  for (std::size_t i = 0; i < edge.cells.size(); ++i) {
    if (travelled_m >= start_m && is_along_wall(view, way, i) &&
        edge.clearance_m[index(i)] <= least_ahead_m(view, way, i, options.constriction_ahead_m) +
                                          options.constriction_tolerance_m) {
      return i;
    }
    if (i + 1 < edge.cells.size()) {
      travelled_m += profile.step_m[std::min(index(i), index(i + 1))];
    }
  }
  return std::nullopt;
}

std::vector<AxisSite> axis_sites(const LocalView& view, const PlaceOptions& options) {
  const MedialAxis& axis = view.axis;
  std::vector<std::size_t> parent(axis.nodes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::vector<bool> is_inner(axis.edges.size(), false);
  for (std::size_t e = 0; e < axis.edges.size(); ++e) {
    if (joins_its_ends(view, e, options)) {
      const std::size_t a = root_of(&parent, axis.edges[e].from);
      const std::size_t b = root_of(&parent, axis.edges[e].to);
      parent[std::max(a, b)] = std::min(a, b);
      is_inner[e] = true;
    }
  }
  std::vector<AxisSite> by_root(axis.nodes.size());
  for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
    if (!is_site_node(axis.nodes[n])) {
      continue;
    }
    AxisSite& site = by_root[root_of(&parent, n)];
    site.nodes.push_back(n);
    for (std::size_t e = 0; e < axis.edges.size(); ++e) {
      if (!is_inner[e] && axis.edges[e].from == n) {
        site.ways.push_back({e, true});
      }
      if (!is_inner[e] && axis.edges[e].to == n) {
        site.ways.push_back({e, false});
      }
    }
  }
  std::vector<AxisSite> sites;
  for (AxisSite& site : by_root) {
    if (!site.nodes.empty()) {
      sites.push_back(std::move(site));
    }
  }
  return sites;
}

}  // namespace cairn
