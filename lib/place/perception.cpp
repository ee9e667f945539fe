#include "place/perception.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "place/local_view.hpp"

namespace cairn {
namespace {

/// Polylines of the axis are drawn this near to its cells.
constexpr double kNearAxis_m = 0.06;

double distance_to_chord(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d chord = b - a;
  const double length = chord.norm();
  return length > 0.0 ? std::abs(chord.x() * (p.y() - a.y()) - chord.y() * (p.x() - a.x())) / length
                      : (p - a).norm();
}

/// The points of a line that are needed to stay near it (Douglas and Peucker, 1973).
std::vector<Vector2d> simplified(const std::vector<Vector2d>& line) {
  std::vector<bool> is_kept(line.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
  is_kept.front() = is_kept.back() = true;
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double most_m = kNearAxis_m;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance_m = distance_to_chord(line[i], line[first], line[last]);
      if (distance_m > most_m) {
        most_m = distance_m;
        farthest = i;
      }
    }
    if (farthest != first) {
      is_kept[farthest] = true;
      open.emplace_back(first, farthest);
      open.emplace_back(farthest, last);
    }
  }
  std::vector<Vector2d> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (is_kept[i]) {
      kept.push_back(line[i]);
    }
  }
  return kept;
}

/// What of a window lies within another grid.
StateGrid cut_to(const StateGrid& window, const GridGeometry& within) {
  const GridGeometry& geometry = window.geometry();
  const Vector2d high = within.origin_m + within.cell_m * Vector2d(within.width, within.height);
  const Cell first = geometry.cell_at(within.origin_m + Vector2d::Constant(1e-6));
  const Cell last = geometry.cell_at(high - Vector2d::Constant(1e-6));
  GridGeometry cut = geometry;
  cut.origin_m += geometry.cell_m * Vector2d(first.x, first.y);
  cut.width = std::max(0, last.x - first.x + 1);
  cut.height = std::max(0, last.y - first.y + 1);
  StateGrid grid(cut);
  for (int y = 0; y < cut.height; ++y) {
    for (int x = 0; x < cut.width; ++x) {
      const Cell there{first.x + x, first.y + y};  // Unknown beyond the window.
      grid.cells()[cut.index_of({x, y})] = window.state(there);
    }
  }
  return grid;
}

/// A window around a point that holds all of a grid.
double window_for(const GridGeometry& grid, const Vector2d& p) {
  const Vector2d high = grid.origin_m + grid.cell_m * Vector2d(grid.width, grid.height);
  const double reach_m = std::max((p - grid.origin_m).maxCoeff(), (high - p).maxCoeff());
  return std::clamp(2.0 * reach_m + 0.5, 4.0, 100.0);
}

bool is_same_line(const Gateway& a, const Gateway& b) {
  return (a.middle - b.middle).norm() < 1e-6 && std::abs(a.width_m - b.width_m) < 1e-6;
}

std::vector<NumberedOpening> openings_of(const PlaceNeighbourhood& place) {
  std::vector<NumberedOpening> openings;
  std::vector<ConsideredOpening> others = place.considered;
  for (std::size_t i = 0; i < place.gateways.size(); ++i) {
    const auto found = std::find_if(
        others.begin(), others.end(),
        [&](const ConsideredOpening& one) { return is_same_line(one.line, place.gateways[i]); });
    ConsideredOpening opening;
    if (found != others.end()) {
      opening = *found;
      others.erase(found);
    } else {
      opening.line = place.gateways[i];
      opening.state = OpeningState::kGateway;
      opening.reason = OpeningReason::kNotKept;
    }
    openings.push_back({opening, static_cast<int>(i)});
  }
  for (const ConsideredOpening& other : others) {
    openings.push_back({other, -1});
  }
  return openings;
}

}  // namespace

PlacePerception perceive(const PlaceVisit& visit, const PlaceOptions& options) {
  PlacePerception perception;
  perception.openings = openings_of(visit.neighbourhood);
  if (visit.lpm.geometry().cell_count() == 0) {
    return perception;
  }
  PlaceOptions wide = options;
  wide.window_m = window_for(visit.lpm.geometry(), visit.neighbourhood.center);
  LocalViewer viewer;
  const LocalView view =
      viewer.look_around(visit.lpm, visit.neighbourhood.center, wide, options.min_corner_rad);
  perception.looked_at = cut_to(view.grid, visit.lpm.geometry());
  for (const AxisEdge& edge : view.axis.edges) {
    std::vector<Vector2d> line;
    line.reserve(edge.cells.size());
    for (const Cell cell : edge.cells) {
      line.push_back(view.grid.geometry().center_of(cell));
    }
    if (line.size() > 1) {
      perception.axis.push_back(simplified(line));
    }
  }
  return perception;
}

}  // namespace cairn
