#include "place/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "place/axis_sites.hpp"
#include "place/gateways.hpp"
#include "place/local_view.hpp"
#include "place/passage.hpp"
#include "place/region.hpp"
#include "place/small_scale_star.hpp"

namespace cairn {
namespace {

/// Corners of the axis are looked for from somewhat weaker turns on; the directions beyond the
/// gateways decide.
constexpr double kWeakCorner = 0.8;

/// Walls seen so much farther than the depth that makes a passage: an opening makes a place by
/// itself. At a place that is one anyway less is enough for a gateway.
constexpr double kBeyondDoubt_m = 0.5;

/// The mean of the nodes where most edges meet: where ways meet rather than where the axis turns or
/// ends, if there is any such.
Vector2d center_of(const LocalView& view, const AxisSite& site) {
  const auto rank = [&](std::size_t n) {
    const std::size_t degree = view.axis.nodes[n].edges.size();
    return std::min<std::size_t>(degree, 3);
  };
  std::size_t best = 0;
  for (const std::size_t n : site.nodes) {
    best = std::max(best, rank(n));
  }
  Vector2d sum = Vector2d::Zero();
  double count = 0.0;
  for (const std::size_t n : site.nodes) {
    if (rank(n) == best) {
      sum += view.grid.geometry().center_of(view.axis.nodes[n].cell);
      count += 1.0;
    }
  }
  return sum / count;
}

/// Of the site's nodes the nearest to a point: free space, which their mean need not be.
Vector2d nearest_node(const LocalView& view, const AxisSite& site, const Vector2d& p) {
  const auto at = [&](std::size_t n) {
    return view.grid.geometry().center_of(view.axis.nodes[n].cell);
  };
  const auto nearest =
      std::min_element(site.nodes.begin(), site.nodes.end(), [&](std::size_t a, std::size_t b) {
        return (at(a) - p).squaredNorm() < (at(b) - p).squaredNorm();
      });
  return at(*nearest);
}

bool is_near_node(const LocalView& view, const AxisSite& site) {
  return std::any_of(site.nodes.begin(), site.nodes.end(), [&](std::size_t n) {
    const AxisNode& node = view.axis.nodes[n];
    const double cells = std::hypot(view.robot.x - node.cell.x, view.robot.y - node.cell.y);
    return cells * view.grid.geometry().cell_m <= node.clearance_m;
  });
}

/// The gateways of the first reading but for unsure ones of some kind.
template <typename Kind>
std::vector<Gateway> gateways_without(const PlaceNeighbourhood& place, Kind is_of_kind) {
  std::vector<Gateway> kept;
  for (const Gateway& gateway : place.gateways) {
    const auto unsure = std::find_if(
        place.unsure.begin(), place.unsure.end(),
        [&](const UnsureGateway& one) { return one.gateway.basis_points == gateway.basis_points; });
    if (unsure == place.unsure.end() || !is_of_kind(*unsure)) {
      kept.push_back(gateway);
    }
  }
  return kept;
}

/// A place lets the robot choose, turn, or return. Doorways through which it has not
/// gone make no place.
bool is_place(const PlaceNeighbourhood& place, const PlaceOptions& options) {
  const std::vector<Gateway> gateways = gateways_without(place, [&](const UnsureGateway& one) {
    return one.is_doorway || one.gateway.seen_beyond_m <
                                 passage_depth_m(one.gateway.width_m, options) + kBeyondDoubt_m;
  });
  if (gateways.size() != 2) {
    return !gateways.empty();
  }
  const double turn =
      turn_between(gateways[0].outward_bearing_rad + kPi, gateways[1].outward_bearing_rad);
  return std::abs(turn) >= options.min_corner_rad;
}

/// The neighbourhood around a site, if it is a place.
std::optional<PlaceNeighbourhood> neighbourhood_of(const LocalView& view,
                                                   const WalledLengths& walled,
                                                   const AxisSite& site,
                                                   const PlaceOptions& options,
                                                   RegionFinder* regions) {
  PlaceNeighbourhood place;
  place.center = center_of(view, site);
  const SiteBounds bounds = bounds_of(view, walled, site, place.center, options);
  StarReadings readings = read_stars(place.center, bounds.gateways, bounds.unsure, options);
  place.gateways = std::move(readings.gateways);
  place.fragments = std::move(readings.fragments);
  place.star = std::move(readings.star);
  place.others = std::move(readings.others);
  place.unsure = bounds.unsure;
  if (!is_place(place, options)) {
    return std::nullopt;
  }
  place.considered = bounds.considered;
  std::vector<Cell> starts;
  for (const std::size_t n : site.nodes) {
    starts.push_back(view.axis.nodes[n].cell);
  }
  std::vector<Gateway> lines = bounds.gateways;
  lines.insert(lines.end(), bounds.closed.begin(), bounds.closed.end());
  for (const UnsureGateway& one : bounds.unsure) {
    lines.push_back(one.gateway);
  }
  const PlaceRegion region = regions->find(starts, lines, place.center);
  place.is_complete = bounds.is_decided && region.is_complete;
  place.radius_m = region.radius_m;
  if (place.is_complete) {
    place.distinctiveness = island_at(view, nearest_node(view, site, place.center)).distinctiveness;
  }
  // With a way still undecided the region has no bound there; only the meeting point counts then.
  place.contains_robot = bounds.is_decided ? region.contains_robot : is_near_node(view, site);
  return place;
}

}  // namespace

std::vector<Gateway> sure_gateways(const PlaceNeighbourhood& place) {
  return gateways_without(place, [](const UnsureGateway&) { return true; });
}

PlaceNeighbourhood transformed(const Pose2& T_to_from, const PlaceNeighbourhood& neighbourhood) {
  PlaceNeighbourhood result = neighbourhood;
  result.center = T_to_from * neighbourhood.center;
  for (Gateway& gateway : result.gateways) {
    gateway = transformed(T_to_from, gateway);
  }
  for (UnsureGateway& one : result.unsure) {
    one.gateway = transformed(T_to_from, one.gateway);
  }
  for (ConsideredOpening& opening : result.considered) {
    opening.line = transformed(T_to_from, opening.line);
  }
  return result;
}

std::vector<PlaceNeighbourhood> find_places(const OccupancyGrid& grid,
                                            const Vector2d& p_grid_robot,
                                            const PlaceOptions& options,
                                            PlaceMemory memory) {
  LocalViewer viewer;
  return find_places(grid, p_grid_robot, options, std::move(memory), &viewer).places;
}

PlacesAround find_places(const OccupancyGrid& grid,
                         const Vector2d& p_grid_robot,
                         const PlaceOptions& options,
                         PlaceMemory memory,
                         LocalViewer* viewer) {
  LocalView view =
      viewer->look_around(grid, p_grid_robot, options, kWeakCorner * options.min_corner_rad);
  view.memory = std::move(memory);
  PlacesAround around;
  around.at_robot = island_at(view, p_grid_robot);
  const WalledLengths walled(view);
  RegionFinder regions(view, options.robot_width_m);
  for (const AxisSite& site : axis_sites(view, options)) {
    std::optional<PlaceNeighbourhood> place =
        neighbourhood_of(view, walled, site, options, &regions);
    // As long as the star is not complete, not all walls are seen that tell a pose there.
    if (place && (!place->is_complete || place->distinctiveness >= options.min_distinctiveness)) {
      around.places.push_back(*std::move(place));
    }
  }
  return around;
}

}  // namespace cairn
