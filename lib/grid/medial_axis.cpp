#include "grid/medial_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/validator.hpp"
#include "grid/axis_graph.hpp"
#include "grid/clearance_order.hpp"
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
  const std::vector<std::int32_t>& squared = frame.distances.squared_clearances_cells();
  for (std::size_t i = 0; i < mask.cells.size(); ++i) {
    mask.cells[i] = static_cast<double>(squared[i]) >= least ? 1 : 0;
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

/// The 8-connected piece of a set that holds a cell, found row by row in runs of cells.
CellMask component_of(const CellMask& set, std::size_t start) {
  CellMask piece(set.width, set.height);
  const auto width = static_cast<std::size_t>(set.width);
  std::vector<std::size_t> open{start};
  while (!open.empty()) {
    const std::size_t seed = open.back();
    open.pop_back();
    if (piece.cells[seed] != 0) {
      continue;
    }
    const std::size_t row = seed - seed % width;
    std::size_t begin = seed;
    std::size_t end = seed + 1;
    while (begin > row && set.cells[begin - 1] != 0) {
      --begin;
    }
    while (end < row + width && set.cells[end] != 0) {
      ++end;
    }
    std::fill_n(piece.cells.begin() + static_cast<std::ptrdiff_t>(begin), end - begin,
                std::uint8_t{1});
    const std::size_t from = begin > row ? begin - 1 : begin;
    const std::size_t to = end < row + width ? end + 1 : end;
    // Of the rows above and below one cell of every run that touches this one.
    const auto add_runs = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (set.cells[i] != 0 && piece.cells[i] == 0 && (i + 1 == last || set.cells[i + 1] == 0)) {
          open.push_back(i);
        }
      }
    };
    if (row >= width) {
      add_runs(from - width, to - width);
    }
    if (row + width < set.cells.size()) {
      add_runs(from + width, to + width);
    }
  }
  return piece;
}

/// Whether the angle between the basis points of two neighbours, each seen from its own cell, is
/// larger than that of the cosine.
bool look_apart(const DistanceTransform& distances, Cell a, Cell b, double max_cosine) {
  const auto to_basis = [&distances](Cell from) {
    const Cell to = distances.basis_point(from);
    return Vector2d(to.x - from.x, to.y - from.y);
  };
  const Vector2d from_a = to_basis(a);
  const Vector2d from_b = to_basis(b);
  const double dot = from_a.dot(from_b);
  // Most neighbours look to the same wall: no roots needed.
  const bool is_same_wall = dot >= 0.0 && max_cosine <= 0.0;
  return !is_same_wall && dot < max_cosine * from_a.norm() * from_b.norm();
}

/// Cells between basis points that lie far apart: where two neighbours look to different walls, the
/// one with the larger clearance.
CellMask ridge_cells(const Frame& frame, const CellMask& set, double min_angle_rad) {
  CellMask ridge(set.width, set.height);
  const double max_cosine = std::cos(min_angle_rad);
  const std::vector<std::int32_t>& squared = frame.distances.squared_clearances_cells();
  const std::vector<std::int32_t>& basis = frame.distances.basis_indices();
  for (int y = 0; y < set.height; ++y) {
    for (int x = 0; x < set.width; ++x) {
      if (!set.has(x, y)) {
        continue;
      }
      for (const auto& [dx, dy] : std::array<std::array<int, 2>, 2>{{{1, 0}, {0, 1}}}) {
        if (!set.has(x + dx, y + dy)) {
          continue;
        }
        const std::size_t a = set.index_of(x, y);
        const std::size_t b = set.index_of(x + dx, y + dy);
        // Neighbours with one basis point see it at less than a right angle.
        const bool is_same = max_cosine <= 0.0 && basis[a] == basis[b];
        if (!is_same &&
            look_apart(frame.distances, frame.cell(x, y), frame.cell(x + dx, y + dy), max_cosine)) {
          ridge.cells[squared[a] >= squared[b] ? a : b] = 1;
        }
      }
    }
  }
  return ridge;
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
  thin(cells_by_clearance(distances, set), ridge, &set);

  return pruned(traced_axis(set, distances), options.coastal_distance_m, distances);
}

}  // namespace cairn
