#include "place/island.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace cairn {
namespace {

constexpr int kRays = 144;
constexpr double kRay_rad = 2.0 * kPi / kRays;
constexpr double kMaxRange_m = 15.0;
/// Influence of a wall fades with distance by this constant.
constexpr double kFading_m = 8.0;
/// Hits farther from a line than this are on another wall: cells have a size.
constexpr double kOnLine_m = 0.15;
constexpr std::size_t kLeastHits = 3;
/// A spread of hits along walls as large as this tells the heading as well as a wall can.
constexpr double kFullLever_m = 1.0;
/// The sigmoid: strengths below the cutoff are poor, those above good; and how sharply.
constexpr double kCutoff = 0.3;
constexpr double kSharpness = 0.1;
/// What the quality of orthogonality counts for.
constexpr double kQualityWeight = 0.5;

struct Hit {
  Vector2d p = Vector2d::Zero();  ///< From the viewer.
  double range_m = 0.0;
};

/// The bearings of the rays, as unit vectors.
const std::array<Vector2d, kRays>& ray_directions() {
  static const std::array<Vector2d, kRays> directions = [] {
    std::array<Vector2d, kRays> all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double bearing_rad = kRay_rad * static_cast<double>(i);
      all[i] = {std::cos(bearing_rad), std::sin(bearing_rad)};
    }
    return all;
  }();
  return directions;
}

/// How many cells a ray may step on from a cell by its squared clearance: nothing lies that near.
double free_step_cells(std::int32_t squared) {
  if (squared == DistanceTransform::kUnbounded) {
    return 0.5;
  }
  return std::max(0.5, std::sqrt(static_cast<double>(squared)) - 1.5);
}

/// The same for the clearances that are met indoors, without roots.
const std::array<double, 1024>& free_steps_cells() {
  static const std::array<double, 1024> steps = [] {
    std::array<double, 1024> all{};
    for (std::size_t squared = 0; squared < all.size(); ++squared) {
      all[squared] = free_step_cells(static_cast<std::int32_t>(squared));
    }
    return all;
  }();
  return steps;
}

/// Ranges of the walls in the directions of the rays; 0 where there is none in sight. The rays
/// take their steps by turns: no step of one has to wait for those of the others.
std::array<double, kRays> ranges_of_walls(const LocalView& view, const Vector2d& p_map) {
  const std::array<Vector2d, kRays>& directions = ray_directions();
  const std::array<double, 1024>& steps_cells = free_steps_cells();
  const GridGeometry& geometry = view.grid.geometry();
  const std::int32_t* const squared_cells = view.distances.squared_clearances_cells().data();
  std::array<double, kRays> ranges_m{};
  std::array<std::size_t, kRays> open{};
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (std::size_t count = open.size(); count > 0;) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t ray = open[i];
      const double range_m = ranges_m[ray];
      const Cell cell = geometry.cell_at(p_map + range_m * directions[ray]);
      const std::int32_t squared =
          geometry.contains(cell) ? squared_cells[geometry.index_of(cell)] : 0;
      if (squared == 0) {
        ranges_m[ray] = view.is_wall_at(cell) ? range_m : 0.0;
        continue;
      }
      const auto known = static_cast<std::size_t>(squared);
      ranges_m[ray] += geometry.cell_m *
                       (known < steps_cells.size() ? steps_cells[known] : free_step_cells(squared));
      if (ranges_m[ray] < kMaxRange_m) {
        open[left++] = ray;
      } else {
        ranges_m[ray] = 0.0;
      }
    }
    count = left;
  }
  return ranges_m;
}

/// The part of some hits that lies farthest from the line through its ends.
std::pair<std::size_t, double> farthest(const std::vector<Hit>& hits,
                                        std::size_t first,
                                        std::size_t last) {
  const Vector2d chord = hits[last].p - hits[first].p;
  const double length = chord.norm();
  std::pair<std::size_t, double> most{first, 0.0};
  for (std::size_t i = first + 1; i < last && length > 0.0; ++i) {
    const Vector2d to = hits[i].p - hits[first].p;
    const double distance_m = std::abs(chord.x() * to.y() - chord.y() * to.x()) / length;
    if (distance_m > most.second) {
      most = {i, distance_m};
    }
  }
  return most;
}

/// The wall on which some hits lie: total least squares.
VisibleWall wall_through(const std::vector<Hit>& hits, std::size_t first, std::size_t last) {
  const auto count = static_cast<double>(last - first + 1);
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    mean += hits[i].p / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Vector2d off = hits[i].p - mean;
    xx += off.x() * off.x() / count;
    xy += off.x() * off.y() / count;
    yy += off.y() * off.y() / count;
  }
  const double along_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  VisibleWall wall;
  wall.normal = {-std::sin(along_rad), std::cos(along_rad)};
  wall.normal *= wall.normal.dot(mean) > 0.0 ? -1.0 : 1.0;
  wall.lever_m = std::sqrt(std::max(0.0, 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy)));
  for (std::size_t i = first; i <= last; ++i) {
    const double range_m = hits[i].range_m;
    const double cosine = std::abs(wall.normal.dot(hits[i].p)) / range_m;
    wall.influence += kRay_rad * cosine * std::exp(-range_m / kFading_m);
  }
  return wall;
}

/// Splits a run of hits at corners (iterative end-point fit) and takes up the walls.
void take_walls(const std::vector<Hit>& run, std::vector<VisibleWall>* walls) {
  if (run.size() < kLeastHits) {
    return;
  }
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, run.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    if (last - first + 1 < kLeastHits) {
      continue;
    }
    const auto [corner, distance_m] = farthest(run, first, last);
    if (distance_m > kOnLine_m) {
      open.emplace_back(corner, last);
      open.emplace_back(first, corner);
    } else {
      walls->push_back(wall_through(run, first, last));
    }
  }
}

/// 0 without any constraint, 1 for a plentiful one.
double sigmoid(double strength) {
  const auto at = [](double s) { return 1.0 / (1.0 + std::exp((kCutoff - s) / kSharpness)); };
  return std::clamp((at(strength) - at(0.0)) / (1.0 - at(0.0)), 0.0, 1.0);
}

}  // namespace

std::vector<VisibleWall> visible_walls(const LocalView& view, const Vector2d& p_map) {
  const std::array<Vector2d, kRays>& directions = ray_directions();
  const std::array<double, kRays> ranges_m = ranges_of_walls(view, p_map);
  std::size_t start = 0;  // Behind a gap, so that no wall is cut in two there.
  for (std::size_t i = 0; i < directions.size(); ++i) {
    start = ranges_m[i] > 0.0 ? start : i;
  }
  std::vector<VisibleWall> walls;
  std::vector<Hit> run;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t ray = (start + i) % directions.size();
    if (ranges_m[ray] > 0.0) {
      run.push_back({ranges_m[ray] * directions[ray], ranges_m[ray]});
    } else {
      take_walls(run, &walls);
      run.clear();
    }
  }
  take_walls(run, &walls);
  return walls;
}

IslandMeasure island_measure(const std::vector<VisibleWall>& walls) {
  IslandMeasure measure;
  const auto strongest = std::max_element(
      walls.begin(), walls.end(),
      [](const VisibleWall& a, const VisibleWall& b) { return a.influence < b.influence; });
  if (strongest == walls.end()) {
    return measure;
  }
  const Vector2d along = strongest->normal;
  const Vector2d across(-along.y(), along.x());
  for (const VisibleWall& wall : walls) {
    measure.dominating += wall.influence * std::abs(wall.normal.dot(along));
    measure.weaker += wall.influence * std::abs(wall.normal.dot(across));
    measure.heading += wall.influence * std::min(1.0, wall.lever_m / kFullLever_m);
  }
  if (measure.weaker > measure.dominating) {
    std::swap(measure.weaker, measure.dominating);
  }
  measure.quality = measure.dominating > 0.0 ? measure.weaker / measure.dominating : 0.0;
  const double decisive = std::min(sigmoid(measure.weaker), sigmoid(measure.heading));
  measure.distinctiveness = decisive * (1.0 - kQualityWeight + kQualityWeight * measure.quality);
  return measure;
}

IslandMeasure island_at(const LocalView& view, const Vector2d& p_map) {
  return island_measure(visible_walls(view, p_map));
}

}  // namespace cairn
