#include "place/axis_sites.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/angle.hpp"
#include "grid/axis_graph.hpp"

namespace cairn {
namespace {

/// Clearance outside of the node's disc is only looked at from this share of its radius on: the
/// corners of a junction often lie a little inside.
constexpr double kShareOfDisc = 0.8;
/// A passage narrower than this share of the space on both sides is a doorway.
constexpr double kDoorwayShare = 0.6;

double step_m(const AxisEdge& edge, std::size_t i, double cell_m) {
  return length_m(edge, i, i + 1, cell_m);
}

/// The position that lies `reach_m` along the edge from another one, or its end.
std::size_t position_after(
    const AxisEdge& edge, std::size_t i, bool forward, double reach_m, double cell_m) {
  double travelled_m = 0.0;
  while (travelled_m < reach_m && (forward ? i + 1 < edge.cells.size() : i > 0)) {
    travelled_m += step_m(edge, forward ? i : i - 1, cell_m);
    i = forward ? i + 1 : i - 1;
  }
  return i;
}

/// How far the axis turns around a position, seen over a reach that grows with the passage's width.
double turn_at(const AxisEdge& edge, std::size_t i, double cell_m) {
  const double reach_m = 1.0 + edge.clearance_m[i];
  const std::size_t back = position_after(edge, i, false, reach_m, cell_m);
  const std::size_t ahead = position_after(edge, i, true, reach_m, cell_m);
  if (length_m(edge, back, i, cell_m) < 0.5 * reach_m ||
      length_m(edge, i, ahead, cell_m) < 0.5 * reach_m) {
    return 0.0;
  }
  const auto bearing = [&](std::size_t a, std::size_t b) {
    return std::atan2(edge.cells[b].y - edge.cells[a].y, edge.cells[b].x - edge.cells[a].x);
  };
  return std::abs(turn_between(bearing(back, i), bearing(i, ahead)));
}

/// Positions where an edge turns most, in ascending order; at most one within the reach of another.
std::vector<std::size_t> corners_of(const AxisEdge& edge, double cell_m, double min_turn_rad) {
  std::vector<double> turns;
  turns.reserve(edge.cells.size());
  for (std::size_t i = 0; i < edge.cells.size(); ++i) {
    turns.push_back(turn_at(edge, i, cell_m));
  }
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] < min_turn_rad) {
      continue;
    }
    const double reach_m = 1.0 + edge.clearance_m[i];
    const std::size_t a = position_after(edge, i, false, reach_m, cell_m);
    const std::size_t b = position_after(edge, i, true, reach_m, cell_m);
    const auto first = turns.begin() + static_cast<std::ptrdiff_t>(a);
    const auto last = turns.begin() + static_cast<std::ptrdiff_t>(b) + 1;
    const auto most = std::max_element(first, last);
    if (static_cast<std::size_t>(most - turns.begin()) == i) {
      corners.push_back(i);
    }
  }
  return corners;
}

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
Sides sides_of(const LocalView& view, AxisWay way, std::size_t position) {
  const Cell cell = view.axis.edges[way.edge].cells[index_on_edge(view.axis, way, position)];
  Sides sides;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell beside{cell.x + dx, cell.y + dy};
      if (view.distances.state(beside) == CellState::kFree) {
        const bool is_wall = view.is_wall_at(view.distances.basis_point(beside));
        ++(is_wall ? sides.walls : sides.unknown);
      }
    }
  }
  return sides;
}

/// The least clearance between walls on the stretch ahead of a position, the position included.
double least_ahead_m(const LocalView& view, AxisWay way, std::size_t position, double stretch_m) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  double least_m = edge.clearance_m[index_on_edge(view.axis, way, position)];
  double ahead_m = 0.0;
  for (std::size_t i = position; i + 1 < edge.cells.size() && ahead_m < stretch_m; ++i) {
    const std::size_t next = index_on_edge(view.axis, way, i + 1);
    ahead_m += length_m(edge, index_on_edge(view.axis, way, i), next, view.grid.geometry().cell_m);
    if (is_between_walls(view, way, i + 1)) {
      least_m = std::min(least_m, edge.clearance_m[next]);
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
    for (const std::size_t corner : corners_of(edge, cell_m, min_turn_rad)) {
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

bool is_along_wall(const LocalView& view, AxisWay way, std::size_t position) {
  return sides_of(view, way, position).walls > 0;
}

bool is_between_walls(const LocalView& view, AxisWay way, std::size_t position) {
  return sides_of(view, way, position).unknown == 0;
}

std::optional<std::size_t> first_constriction(const LocalView& view,
                                              AxisWay way,
                                              const PlaceOptions& options) {
  const AxisEdge& edge = view.axis.edges[way.edge];
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
      travelled_m += length_m(edge, index(i), index(i + 1), view.grid.geometry().cell_m);
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
