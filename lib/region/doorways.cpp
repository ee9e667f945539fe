#include "region/doorways.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn {
namespace {

constexpr double kOpposite = -0.9;  ///< Cosine between basis points, seen from the diagram.

struct Line {
  Vector2d middle;
  Vector2d along;  ///< Unit length.
  double length = 0.0;

  explicit Line(const Doorway& doorway) {
    const auto& [a, b] = doorway.basis_points;
    middle = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    length = doorway.length_cells;
    along = (1.0 / length) * Vector2d(b.x - a.x, b.y - a.y);
  }
  [[nodiscard]] Vector2d normal() const { return {-along.y(), along.x()}; }
};

/// Lines between the basis points of neighbouring cells that look to opposite sides.
std::vector<Doorway> candidates(const DistanceTransform& distances, double max_cells) {
  std::vector<Doorway> lines;
  const GridWindow& window = distances.window();
  const auto consider = [&](Cell a, Cell b) {
    const std::int32_t squared = distances.squared_clearance_cells(a);
    if (squared == 0 || squared == DistanceTransform::kUnbounded ||
        4.0 * squared > 1.5 * max_cells * max_cells || distances.squared_clearance_cells(b) == 0) {
      return;
    }
    const Cell p = distances.basis_point(a);
    const Cell q = distances.basis_point(b);
    const Vector2d to_p(p.x - a.x, p.y - a.y);
    const Vector2d to_q(q.x - a.x, q.y - a.y);
    if (to_p.dot(to_q) < kOpposite * to_p.norm() * to_q.norm() &&
        (to_p - to_q).norm() <= max_cells) {
      lines.push_back({{std::min(p, q), std::max(p, q)}, (to_p - to_q).norm()});
    }
  };
  for (int y = window.lower.y; y < window.lower.y + window.height; ++y) {
    for (int x = window.lower.x; x < window.lower.x + window.width; ++x) {
      for (const Cell next : {Cell{x + 1, y}, Cell{x, y + 1}}) {
        if (window.contains(next)) {
          consider({x, y}, next);
        }
      }
    }
  }
  const auto key = [](const Doorway& d) { return std::tuple(d.length_cells, d.basis_points); };
  std::sort(lines.begin(), lines.end(),
            [&](const Doorway& a, const Doorway& b) { return key(a) < key(b); });
  lines.erase(std::unique(lines.begin(), lines.end(),
                          [&](const Doorway& a, const Doorway& b) { return key(a) == key(b); }),
              lines.end());
  return lines;
}

class WallProbe {
 public:
  WallProbe(const DistanceTransform& distances, const RegionOptions& options)
      : distances_(distances),
        widening_(options.widening),
        depth_cells_(options.doorway_depth_m / distances.geometry().cell_m) {}

  [[nodiscard]] bool is_doorway(const Line& line) const {
    return widens(line, line.normal()) && widens(line, -1.0 * line.normal());
  }

 private:
  [[nodiscard]] static Cell cell_at(const Vector2d& p) {
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  }

  [[nodiscard]] bool is_free(const Vector2d& p) const {
    return distances_.state(cell_at(p)) == CellState::kFree;
  }

  /// How far free space goes on from a point, at most so far.
  [[nodiscard]] double reach(const Vector2d& from, const Vector2d& along, double most) const {
    double far = 0.0;
    while (far < most && is_free(from + (far + 1.0) * along)) {
      far += 1.0;
    }
    return far;
  }

  [[nodiscard]] bool widens(const Line& line, const Vector2d& aside) const {
    constexpr double kFirst = 2.0;  // Cells: as far as the grid can tell.
    if (distances_.clearance_m(cell_at(line.middle + kFirst * aside)) <
        distances_.clearance_m(cell_at(line.middle)) - 0.5 * distances_.geometry().cell_m) {
      return false;
    }
    const double wanted = (1.0 + widening_) * line.length;
    for (double depth = 1.0; depth <= depth_cells_; depth += 1.0) {
      const Vector2d at = line.middle + depth * aside;
      if (!is_free(at)) {
        return false;
      }
      const double wide =
          1.0 + reach(at, line.along, wanted) + reach(at, -1.0 * line.along, wanted);
      if (wide >= wanted) {
        return true;
      }
    }
    return false;
  }

  const DistanceTransform& distances_;
  double widening_;
  double depth_cells_;
};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether two lines cross, or are two lines in one doorway.
bool rival(const Line& a, const Line& b) {
  const Vector2d apart = b.middle - a.middle;
  const double sine = cross(a.along, b.along);
  if (apart.norm() < 0.5 * std::min(a.length, b.length) && std::abs(sine) < 0.7) {
    return true;
  }
  if (std::abs(sine) < 1e-9) {
    return false;
  }
  const double on_a = cross(apart, b.along) / sine;
  const double on_b = cross(apart, a.along) / sine;
  return std::abs(on_a) < 0.5 * a.length && std::abs(on_b) < 0.5 * b.length;
}

}  // namespace

std::vector<Doorway> doorways(const DistanceTransform& distances, const RegionOptions& options) {
  const WallProbe probe(distances, options);
  std::vector<Doorway> accepted;
  std::vector<Line> lines;
  for (const Doorway& candidate :
       candidates(distances, options.max_line_m / distances.geometry().cell_m + 1.0)) {
    const Line line(candidate);
    const bool has_rival = std::any_of(lines.begin(), lines.end(),
                                       [&](const Line& other) { return rival(line, other); });
    if (!has_rival && probe.is_doorway(line)) {
      accepted.push_back(candidate);
      lines.push_back(line);
    }
  }
  return accepted;
}

}  // namespace cairn
