#include "grid/ray_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace cairn {
namespace {

/// The part of a segment that lies within a rectangle, in shares of its length (Liang and Barsky).
struct Clip {
  double begin = 0.0;
  double end = 1.0;

  void by_axis(double from, double step, double high) {
    if (step == 0.0) {
      if (from < 0.0 || from > high) {
        end = -1.0;
      }
      return;
    }
    const double a = (0.0 - from) / step;
    const double b = (high - from) / step;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
};

/// One coordinate of the walk along a ray, in cells.
struct Axis {
  int cell = 0;
  int last = 0;
  int direction = 0;
  double next_crossing = 0.0;  // share of the segment at which the next cell begins
  double crossing_step = 0.0;

  Axis(double from, double step, const Clip& clip, int size) {
    const auto cell_at = [&](double share) {
      return std::clamp(static_cast<int>(std::floor(from + share * step)), 0, size - 1);
    };
    cell = cell_at(clip.begin);
    last = cell_at(clip.end);
    direction = last > cell ? 1 : -1;
    if (step == 0.0) {
      next_crossing = std::numeric_limits<double>::infinity();
      return;
    }
    next_crossing = (cell + (step > 0.0 ? 1.0 : 0.0) - from) / step;
    crossing_step = 1.0 / std::abs(step);
  }

  void advance() {
    cell += direction;
    next_crossing += crossing_step;
  }
};

}  // namespace

void trace_ray(const GridGeometry& geometry,
               const Vector2d& from,
               const Vector2d& to,
               std::vector<Cell>* cells) {
  if (geometry.width <= 0 || geometry.height <= 0) {
    return;
  }
  const Vector2d start = (from - geometry.origin_m) / geometry.cell_m;
  const Vector2d step = (to - from) / geometry.cell_m;
  Clip clip;
  clip.by_axis(start.x(), step.x(), geometry.width);
  clip.by_axis(start.y(), step.y(), geometry.height);
  if (clip.begin > clip.end) {
    return;
  }
  Axis x(start.x(), step.x(), clip, geometry.width);
  Axis y(start.y(), step.y(), clip, geometry.height);
  cells->push_back({x.cell, y.cell});
  while (x.cell != x.last || y.cell != y.last) {
    const bool along_x =
        y.cell == y.last || (x.cell != x.last && x.next_crossing <= y.next_crossing);
    (along_x ? x : y).advance();
    cells->push_back({x.cell, y.cell});
  }
}

}  // namespace cairn
