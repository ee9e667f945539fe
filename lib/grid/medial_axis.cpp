#include "grid/medial_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/validator.hpp"
#include "grid/axis_graph.hpp"
#include "grid/thinning.hpp"

namespace cairn {
namespace {

constexpr double kStartSlack_m = 0.5;

/// The window of a transform as a mask, and the way between its cells and those of the grid.
struct Frame {
  const DistanceTransform& distances;
  int width;
  int height;

  [[nodiscard]] Cell cell(int x, int y) const {
    return {distances.window().lower.x + x, distances.window().lower.y + y};
  }
  [[nodiscard]] Cell cell(std::size_t index) const {
    const auto w = static_cast<std::size_t>(width);
    return cell(static_cast<int>(index % w), static_cast<int>(index / w));
  }
};

CellMask passable_cells(const Frame& frame, double min_clearance_m) {
  CellMask mask(frame.width, frame.height);
  const double cells = min_clearance_m / frame.distances.geometry().cell_m;
  const auto least = std::max(1.0, cells * cells);
  for (std::size_t i = 0; i < mask.cells.size(); ++i) {
    const auto squared = frame.distances.squared_clearance_cells(frame.cell(i));
    mask.cells[i] = static_cast<double>(squared) >= least ? 1 : 0;
  }
  return mask;
}

/// Index of the cell of the set that is nearest to a cell of the window, within the slack.
std::size_t nearest_in(const CellMask& set, int x0, int y0, int slack_cells) {
  std::size_t best = set.cells.size();
  int best_squared = std::numeric_limits<int>::max();
  for (int y = y0 - slack_cells; y <= y0 + slack_cells; ++y) {
    for (int x = x0 - slack_cells; x <= x0 + slack_cells; ++x) {
      const int squared = (x - x0) * (x - x0) + (y - y0) * (y - y0);
      if (set.has(x, y) && squared < best_squared && squared <= slack_cells * slack_cells) {
        best = set.index_of(x, y);
        best_squared = squared;
      }
    }
  }
  return best;
}

/// The 8-connected piece of a set that holds a cell.
CellMask component_of(const CellMask& set, std::size_t start) {
  CellMask piece(set.width, set.height);
  std::vector<std::size_t> open{start};
  piece.cells[start] = 1;
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    const int x = static_cast<int>(index % static_cast<std::size_t>(set.width));
    const int y = static_cast<int>(index / static_cast<std::size_t>(set.width));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (set.has(x + dx, y + dy) && !piece.has(x + dx, y + dy)) {
          piece.cells[piece.index_of(x + dx, y + dy)] = 1;
          open.push_back(piece.index_of(x + dx, y + dy));
        }
      }
    }
  }
  return piece;
}

/// Cells between basis points that lie far apart: where two neighbours look to different walls, the
/// one with the larger clearance.
CellMask ridge_cells(const Frame& frame, const CellMask& set, double min_angle_rad) {
  CellMask ridge(set.width, set.height);
  const double max_cosine = std::cos(min_angle_rad);
  const auto toward = [](Cell from, Cell to) { return Vector2d(to.x - from.x, to.y - from.y); };
  for (int y = 0; y < set.height; ++y) {
    for (int x = 0; x < set.width; ++x) {
      for (const auto& [dx, dy] : std::array<std::array<int, 2>, 2>{{{1, 0}, {0, 1}}}) {
        if (!set.has(x, y) || !set.has(x + dx, y + dy)) {
          continue;
        }
        const Cell a = frame.cell(x, y);
        const Cell b = frame.cell(x + dx, y + dy);
        const Vector2d from_a = toward(a, frame.distances.basis_point(a));
        const Vector2d from_b = toward(b, frame.distances.basis_point(b));
        if (from_a.dot(from_b) < max_cosine * from_a.norm() * from_b.norm()) {
          const bool first = frame.distances.squared_clearance_cells(a) >=
                             frame.distances.squared_clearance_cells(b);
          ridge.cells[first ? ridge.index_of(x, y) : ridge.index_of(x + dx, y + dy)] = 1;
        }
      }
    }
  }
  return ridge;
}

/// Indices of the cells of a set, the least clearance first.
std::vector<std::size_t> by_clearance(const Frame& frame, const CellMask& set) {
  std::vector<std::pair<std::int32_t, std::size_t>> keys;
  for (std::size_t i = 0; i < set.cells.size(); ++i) {
    if (set.cells[i] != 0) {
      keys.emplace_back(frame.distances.squared_clearance_cells(frame.cell(i)), i);
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  order.reserve(keys.size());
  for (const auto& key : keys) {
    order.push_back(key.second);
  }
  return order;
}

}  // namespace

Status validate(const MedialAxisOptions& options) {
  return Validator("medial_axis")
      .within("min_clearance_m", options.min_clearance_m, 0.0, 100.0)
      .within("coastal_distance_m", options.coastal_distance_m, 0.0, 100.0)
      .within("min_basis_angle_rad", options.min_basis_angle_rad, 0.01, 3.14)
      .status();
}

MedialAxis medial_axis(const DistanceTransform& distances,
                       Cell start,
                       const MedialAxisOptions& options) {
  const GridWindow& window = distances.window();
  const Frame frame{distances, window.width, window.height};
  const CellMask passable = passable_cells(frame, options.min_clearance_m);
  const int slack_cells = static_cast<int>(std::ceil(kStartSlack_m / distances.geometry().cell_m));
  const std::size_t first =
      nearest_in(passable, start.x - window.lower.x, start.y - window.lower.y, slack_cells);
  if (first == passable.cells.size()) {
    return {};
  }
  CellMask set = component_of(passable, first);
  const CellMask ridge = ridge_cells(frame, set, options.min_basis_angle_rad);
  thin(by_clearance(frame, set), ridge, &set);

  return pruned(traced_axis(set, distances), options.coastal_distance_m, distances);
}

}  // namespace cairn
