#include "place/gateways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "grid/critical_points.hpp"
#include "place/opening_reason.hpp"
#include "place/small_scale_star.hpp"

namespace cairn {
namespace {

/// A constriction is looked for a little beyond where clearance has come down to about its level.
constexpr double kRefine_m = 0.4;
/// The direction of a way is taken over this stretch beyond the gateway.
constexpr double kDirection_m = 1.5;
/// A passage is looked along for so many of the depths that make it one.
constexpr double kDepthsLooked = 2.0;
/// A passage is so many times as deep as wide.
constexpr double kDepthPerWidth = 1.5;
/// A gateway stays one as long as so much of the depth that makes one is seen.
constexpr double kEnoughToStay = 0.7;
constexpr double kSure = std::numeric_limits<double>::infinity();
/// What is less likely to be a passage counts as closed.
constexpr double kLeastLogOdds = -2.5;

/// Where the way has come by some travel from a position on, or its end.
std::size_t position_after(const LocalView& view,
                           AxisWay way,
                           std::size_t position,
                           double travel_m) {
  const std::vector<double>& step_m = view.profiles[way.edge].step_m;
  double travelled_m = 0.0;
  while (position < step_m.size() && travelled_m < travel_m) {
    travelled_m += step_m[way.forward ? position : step_m.size() - 1 - position];
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

double bearing_beyond(const LocalView& view, AxisWay way, std::size_t position) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const std::size_t ahead = position_after(view, way, position, kDirection_m);
  // At least some cells: a single step has but eight directions.
  const std::size_t behind = ahead >= position + 5 ? position : (ahead > 5 ? ahead - 5 : 0);
  const Cell a = edge.cells[index_on_edge(view.axis, way, behind)];
  const Cell b = edge.cells[index_on_edge(view.axis, way, ahead)];
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
  gateway.outward_bearing_rad = bearing_beyond(view, way, position);
  return gateway;
}

/// Whether there is a wall within some distance of a point.
bool is_near_wall(const LocalView& view, const Vector2d& p, double within_m) {
  const GridGeometry& geometry = view.grid.geometry();
  const Cell center = geometry.cell_at(p);
  const int reach = static_cast<int>(std::ceil(within_m / geometry.cell_m));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (view.is_wall_at({center.x + dx, center.y + dy}) &&
          std::hypot(dx, dy) * geometry.cell_m <= within_m) {
        return true;
      }
    }
  }
  return false;
}

/// Whether both ends of a line lie on walls, or just behind their corners. The narrow end of a
/// wedge of known space does not.
bool is_between_two_walls(const LocalView& view, const Gateway& line) {
  constexpr double kBehindCorner_m = 0.6;
  return std::all_of(line.basis_points.begin(), line.basis_points.end(),
                     [&](const Vector2d& p) { return is_near_wall(view, p, kBehindCorner_m); });
}

/// Whether there is no doubt that a passage is one: it was seen to its end, or far enough, for most
/// of it on both sides.
bool is_plain(const Passage& passage, double enough_m) {
  return passage.goes_beyond_map || passage.to_end_m >= 0.5 * enough_m ||
         (passage.along_wall_m >= enough_m &&
          passage.between_walls_m >= kPlainWallShare * enough_m);
}

/// Of the depth of a passage of which there is no doubt, where so much was seen a passage and an
/// alcove are as likely: who turns into another corridor sees little of those beside and behind.
constexpr double kEvenShare = 0.6;

/// The farther walls were seen along it, the likelier an opening is a passage; a doorway may as
/// well lead into a closet.
double log_odds_of_passage(const Passage& passage,
                           double width_m,
                           bool is_doorway,
                           const PlaceOptions& options) {
  constexpr double kPerMetre = 2.0;
  constexpr double kLessForDoorway = 2.0;
  const double enough_m = passage_depth_m(width_m, options);
  constexpr double kMost = 2.0;
  return std::clamp(kPerMetre * (passage.along_wall_m - kEvenShare * enough_m), -kMost, kMost) -
         (is_doorway ? kLessForDoorway : 0.0);
}

/// A way that never narrows, or not between two sides: what is known of it is its end.
ConsideredOpening without_line(const LocalView& view, AxisWay way, bool is_undecided) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const std::size_t last = index_on_edge(view.axis, way, edge.cells.size() - 1);
  ConsideredOpening opening;
  opening.line.middle = view.grid.geometry().center_of(edge.cells[last]);
  opening.line.basis_points = {opening.line.middle, opening.line.middle};
  opening.line.outward_bearing_rad = bearing_beyond(view, way, edge.cells.size() - 1);
  opening.state = is_undecided ? OpeningState::kUndecided : OpeningState::kRejected;
  opening.reason = is_undecided ? OpeningReason::kUnknownBehind : OpeningReason::kBlindAlcove;
  return opening;
}

double bearing_from(const Vector2d& center, const Gateway& gateway) {
  const Vector2d to = gateway.middle - center;
  return std::atan2(to.y(), to.x());
}

void reject_as_too_close(const Gateway& gateway, std::vector<ConsideredOpening>* considered) {
  for (ConsideredOpening& opening : *considered) {
    if (opening.line.basis_points == gateway.basis_points) {
      opening.state = OpeningState::kRejected;
      opening.reason = OpeningReason::kTooClose;
    }
  }
}

/// Whether the line, with what was seen behind it, is a gateway, may be one, or is none.
void judge(const LocalView& view,
           const Gateway& line,
           const Passage& passage,
           const PlaceOptions& options,
           WayOut* out) {
  const double needed_m = passage_depth_m(line.width_m, options);
  const bool is_walled = is_between_two_walls(view, line);
  const bool was_gateway =
      std::any_of(view.memory.gateways.begin(), view.memory.gateways.end(),
                  [&](const Gateway& known) { return is_same_gateway(known, line); });
  const double enough = was_gateway ? kEnoughToStay : 1.0;
  const bool is_plain_way = is_plain(passage, enough * needed_m);
  const bool is_doorway = line.width_m < options.doorway_below_m;
  ConsideredOpening& considered = out->considered;
  considered = {line, considered.state, OpeningReason::kNotBetweenWalls, passage, needed_m, 0.0};
  const bool is_driven = is_driven_through(line, view.memory.robot_way);
  if ((is_walled && !is_doorway && is_plain_way) || is_driven) {
    out->gateway = line;
    out->is_undecided = false;
    considered.state = OpeningState::kGateway;
  } else if (is_walled) {
    out->is_undecided = false;
    considered.log_odds = log_odds_of_passage(passage, line.width_m, is_doorway, options);
    if (considered.log_odds < kLeastLogOdds) {
      out->closed = line;
      considered.state = OpeningState::kRejected;
    } else {
      out->unsure = {line, considered.log_odds, is_doorway};
      considered.state = OpeningState::kUnsure;
    }
  }
  if (is_driven || is_walled) {
    considered.reason = is_driven ? OpeningReason::kDrivenThrough
                                  : reason_between_walls(considered, is_plain_way, options);
  }
}

}  // namespace

double passage_depth_m(double width_m, const PlaceOptions& options) {
  return std::max(options.passage_depth_m, kDepthPerWidth * width_m);
}

WayOut way_out(const LocalView& view,
               const WalledLengths& walled,
               const AxisSite& site,
               AxisWay way,
               const PlaceOptions& options) {
  const AxisEdge& edge = view.axis.edges[way.edge];
  const AxisEnd end = view.axis.nodes[way.forward ? edge.to : edge.from].end;
  WayOut out;
  out.is_undecided = end != AxisEnd::kBlocked;
  out.considered = without_line(view, way, out.is_undecided);
  const auto first = first_constriction(view, way, options);
  if (!first) {
    return out;
  }
  const std::size_t last = position_after(view, way, *first, kRefine_m);
  const std::size_t position = narrowest_between(view.axis, way, *first, last);
  std::optional<Gateway> line = gateway_at(view, way, position);
  if (!line) {
    return out;
  }
  const Passage passage =
      passage_beyond(view, walled, site, way, position, kDepthsLooked * options.passage_depth_m);
  line->seen_beyond_m = passage.along_wall_m;
  judge(view, *line, passage, options, &out);
  return out;
}

SiteBounds bounds_of(const LocalView& view,
                     const WalledLengths& walled,
                     const AxisSite& site,
                     const Vector2d& center,
                     const PlaceOptions& options) {
  SiteBounds bounds;
  std::vector<UnsureGateway> found;
  for (const AxisWay& way : site.ways) {
    const WayOut out = way_out(view, walled, site, way, options);
    bounds.is_decided = bounds.is_decided && !out.is_undecided;
    bounds.considered.push_back(out.considered);
    if (out.gateway) {
      found.push_back({*out.gateway, kSure, false});
    } else if (out.unsure) {
      found.push_back(*out.unsure);
    } else if (out.closed) {
      bounds.closed.push_back(*out.closed);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const UnsureGateway& a, const UnsureGateway& b) {
    return std::tuple(a.log_odds == kSure, a.gateway.width_m) >
           std::tuple(b.log_odds == kSure, b.gateway.width_m);
  });
  std::vector<Gateway> kept;
  for (const UnsureGateway& one : found) {
    const bool is_separate = std::none_of(kept.begin(), kept.end(), [&](const Gateway& g) {
      return std::abs(turn_between(bearing_from(center, g), bearing_from(center, one.gateway))) <
             options.min_gateway_separation_rad;
    });
    if (!is_separate) {
      bounds.closed.push_back(one.gateway);
      reject_as_too_close(one.gateway, &bounds.considered);
      continue;
    }
    kept.push_back(one.gateway);
    if (one.log_odds == kSure) {
      bounds.gateways.push_back(one.gateway);
    } else {
      bounds.unsure.push_back(one);
    }
  }
  sort_clockwise(center, &bounds.gateways);
  return bounds;
}

}  // namespace cairn
