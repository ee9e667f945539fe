#include "place/gateways.hpp"

#include <algorithm>
#include <cmath>

#include "grid/axis_graph.hpp"
#include "grid/critical_points.hpp"
#include "place/small_scale_star.hpp"

namespace cairn {
namespace {

/// A constriction is looked for a little beyond where clearance has come down to about its level.
constexpr double kRefine_m = 0.4;
/// The direction of a way is taken over this stretch beyond the gateway.
constexpr double kDirection_m = 1.5;

/// Where the way has come by some travel from a position on, or its end.
std::size_t position_after(
    const MedialAxis& axis, AxisWay way, std::size_t position, double travel_m, double cell_m) {
  const AxisEdge& edge = axis.edges[way.edge];
  double travelled_m = 0.0;
  while (position + 1 < edge.cells.size() && travelled_m < travel_m) {
    travelled_m += length_m(edge, index_on_edge(axis, way, position),
                            index_on_edge(axis, way, position + 1), cell_m);
    ++position;
  }
  return position;
}

std::size_t narrowest_between(const MedialAxis& axis,
                              AxisWay way,
                              std::size_t first,
                              std::size_t last) {
  const AxisEdge& edge = axis.edges[way.edge];
  std::size_t best = first;
  for (std::size_t i = first; i <= last; ++i) {
    if (edge.clearance_m[index_on_edge(axis, way, i)] <
        edge.clearance_m[index_on_edge(axis, way, best)]) {
      best = i;
    }
  }
  return best;
}

/// Known passage from a position on. Only stretches that walls bound count: what a few beams show
/// through a door or a window is bounded by unknown space, and might be no passage at all.
double seen_beyond_m(const LocalView& view, AxisWay way, std::size_t position) {
  const double cell_m = view.grid.geometry().cell_m;
  const AxisEdge& edge = view.axis.edges[way.edge];
  double seen_m = 0.0;
  for (std::size_t i = position; i + 1 < edge.cells.size(); ++i) {
    const std::size_t index = index_on_edge(view.axis, way, i);
    if (is_along_wall(view, way, i)) {
      seen_m += length_m(edge, index, index_on_edge(view.axis, way, i + 1), cell_m);
    }
  }
  const AxisNode& end = view.axis.nodes[way.forward ? edge.to : edge.from];
  const bool is_bounded = end.end == AxisEnd::kMeets || end.end == AxisEnd::kBlocked;
  return seen_m + (is_bounded ? end.clearance_m : 0.0);
}

double bearing_beyond(const LocalView& view,
                      const MedialAxis& axis,
                      AxisWay way,
                      std::size_t position) {
  const double cell_m = view.grid.geometry().cell_m;
  const AxisEdge& edge = axis.edges[way.edge];
  const std::size_t ahead = position_after(axis, way, position, kDirection_m, cell_m);
  // At least some cells: a single step has but eight directions.
  const std::size_t behind = ahead >= position + 5 ? position : (ahead > 5 ? ahead - 5 : 0);
  const Cell a = edge.cells[index_on_edge(axis, way, behind)];
  const Cell b = edge.cells[index_on_edge(axis, way, ahead)];
  return std::atan2(b.y - a.y, b.x - a.x);
}

std::optional<Gateway> gateway_at(const LocalView& view, AxisWay way, std::size_t position) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const std::size_t index = index_on_edge(view.axis, way, position);
  std::array<Cell, 2> basis = basis_points_at(view.distances, edge, index);
  if (basis[0] == edge.cells[index] || basis[1] == edge.cells[index]) {
    return std::nullopt;
  }
  if (!way.forward) {
    std::swap(basis[0], basis[1]);
  }
  const GridGeometry& geometry = view.grid.geometry();
  Gateway gateway;
  gateway.basis_points = {geometry.center_of(basis[0]), geometry.center_of(basis[1])};
  gateway.middle = geometry.center_of(edge.cells[index]);
  gateway.width_m = (gateway.basis_points[0] - gateway.basis_points[1]).norm();
  gateway.outward_bearing_rad = bearing_beyond(view, view.axis, way, position);
  return gateway;
}

/// Whether both ends of a line lie on walls. The narrow end of a wedge of known space does not.
bool is_between_two_walls(const LocalView& view, const Gateway& line) {
  return std::all_of(line.basis_points.begin(), line.basis_points.end(), [&](const Vector2d& p) {
    return view.is_wall_at(view.grid.geometry().cell_at(p));
  });
}

double bearing_from(const Vector2d& center, const Gateway& gateway) {
  const Vector2d to = gateway.middle - center;
  return std::atan2(to.y(), to.x());
}

}  // namespace

WayOut way_out(const LocalView& view, AxisWay way, const PlaceOptions& options) {
  const double cell_m = view.grid.geometry().cell_m;
  const AxisEdge& edge = view.axis.edges[way.edge];
  const AxisEnd end = view.axis.nodes[way.forward ? edge.to : edge.from].end;
  WayOut out;
  out.is_undecided = end != AxisEnd::kBlocked;
  const auto first = first_constriction(view, way, options);
  if (!first) {
    return out;
  }
  const std::size_t last = position_after(view.axis, way, *first, kRefine_m, cell_m);
  const std::size_t position = narrowest_between(view.axis, way, *first, last);
  std::optional<Gateway> line = gateway_at(view, way, position);
  if (!line) {
    return out;
  }
  line->seen_beyond_m = seen_beyond_m(view, way, position);
  const bool is_narrow = line->width_m < options.doorway_below_m;
  if (line->seen_beyond_m >= (is_narrow ? options.doorway_depth_m : options.seen_beyond_m)) {
    out.gateway = line;
    out.is_undecided = false;
  } else if (is_narrow && is_between_two_walls(view, *line)) {
    out.closed = line;
    out.is_undecided = false;
  }
  return out;
}

SiteBounds bounds_of(const LocalView& view,
                     const AxisSite& site,
                     const Vector2d& center,
                     const PlaceOptions& options) {
  SiteBounds bounds;
  std::vector<Gateway> found;
  for (const AxisWay& way : site.ways) {
    const WayOut out = way_out(view, way, options);
    bounds.is_decided = bounds.is_decided && !out.is_undecided;
    if (out.gateway) {
      found.push_back(*out.gateway);
    }
    if (out.closed) {
      bounds.closed.push_back(*out.closed);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Gateway& a, const Gateway& b) { return a.width_m > b.width_m; });
  for (const Gateway& gateway : found) {
    const bool is_separate =
        std::none_of(bounds.gateways.begin(), bounds.gateways.end(), [&](const Gateway& g) {
          return std::abs(turn_between(bearing_from(center, g), bearing_from(center, gateway))) <
                 options.min_gateway_separation_rad;
        });
    (is_separate ? bounds.gateways : bounds.closed).push_back(gateway);
  }
  sort_clockwise(center, &bounds.gateways);
  return bounds;
}

}  // namespace cairn
