#include "planning/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr double kFarthest_m = 1e6;
constexpr int kCoarseFactor = 4;
/// How far a path may be from the way over large cells, in small cells.
constexpr int kGuideReach_cells = 7;

std::string text_of(const Vector2d& point_m) {
  std::array<char, 64> text{};
  static_cast<void>(
      std::snprintf(text.data(), text.size(), "(%.2f, %.2f) m", point_m.x(), point_m.y()));
  return text.data();
}

std::string text_of(double value_m) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.2f m", value_m));
  return text.data();
}

bool is_sound(const Vector2d& point_m) {
  return std::abs(point_m.x()) <= kFarthest_m && std::abs(point_m.y()) <= kFarthest_m;
}

/// The cells at which a path over cells changes its direction, and both ends.
std::vector<std::size_t> corners_of(const std::vector<Cell>& cells) {
  std::vector<std::size_t> corners{0};
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
    if (cells[i + 1].x - cells[i].x != cells[i].x - cells[i - 1].x ||
        cells[i + 1].y - cells[i].y != cells[i].y - cells[i - 1].y) {
      corners.push_back(i);
    }
  }
  if (cells.size() > 1) {
    corners.push_back(cells.size() - 1);
  }
  return corners;
}

double length_of(const std::vector<Vector2d>& points_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    length_m += (points_m[i] - points_m[i - 1]).norm();
  }
  return length_m;
}

/// Points at most `spacing_m` apart along the same lines.
std::vector<Vector2d> resampled(const std::vector<Vector2d>& points_m, double spacing_m) {
  std::vector<Vector2d> dense{points_m.front()};
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const Vector2d line = points_m[i] - points_m[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(line.norm() / spacing_m - 1e-9)));
    for (int part = 1; part <= parts; ++part) {
      dense.emplace_back(points_m[i - 1] + static_cast<double>(part) / parts * line);
    }
  }
  return dense;
}

std::vector<Pose2> waypoints_of(const std::vector<Vector2d>& points_m,
                                std::optional<double> goal_heading_rad) {
  std::vector<Pose2> waypoints;
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (i + 1 < points_m.size()) {
      const Vector2d ahead = points_m[i + 1] - points_m[i];
      heading_rad = std::atan2(ahead.y(), ahead.x());
    } else if (goal_heading_rad) {
      heading_rad = *goal_heading_rad;
    }
    waypoints.emplace_back(points_m[i], heading_rad);
  }
  return waypoints;
}

}  // namespace

Status validate(const PathOptions& options) {
  if (const Status sound = validate(options.search); !sound) {
    return sound;
  }
  return Validator("path")
      .within("corridor_m", options.corridor_m, 0.1, 100.0)
      .within("waypoint_spacing_m", options.waypoint_spacing_m, 0.01, 100.0)
      .within("start_tolerance_m", options.start_tolerance_m, 0.0, 10.0)
      .within("goal_tolerance_m", options.goal_tolerance_m, 0.0, 10.0)
      .status();
}

PathPlanner::PathPlanner(const OccupancyGrid& grid, const PathOptions& options)
    : options_(options),
      search_(grid, options.search),
      coarse_search_(search_.coarsened(kCoarseFactor)) {
  CAIRN_CHECK(validate(options).ok());
}

Result<MetricPath> PathPlanner::find_path(const Vector2d& start_m,
                                          const PathGoal& goal,
                                          const std::vector<Vector2d>& route_m) {
  if (goal.heading_rad && !std::isfinite(*goal.heading_rad)) {
    return Error{ErrorCode::kInvalidValue, "path: the goal's heading must be finite"};
  }
  const Result<Cell> start = standing_cell(start_m, options_.start_tolerance_m, "start");
  if (!start) {
    return start.error();
  }
  const Result<Cell> end = standing_cell(goal.point_m, options_.goal_tolerance_m, "goal");
  if (!end) {
    return end.error();
  }
  MetricPath path;
  const Result<GridPath> cells = search_cells(*start, *end, route_m, &path.left_corridor);
  if (!cells) {
    return Error{cells.error().code,
                 "path: no way from " + text_of(start_m) + " to " + text_of(goal.point_m)};
  }
  const std::vector<Vector2d> points_m = with_exact_ends(shortened(*cells), start_m, goal.point_m);
  path.length_m = length_of(points_m);
  path.least_clearance_m = least_clearance_m(points_m);
  path.T_global_waypoint =
      waypoints_of(resampled(points_m, options_.waypoint_spacing_m), goal.heading_rad);
  return path;
}

/// The cell of a point, or one near to it where the robot can stand; otherwise why not.
Result<Cell> PathPlanner::standing_cell(const Vector2d& point_m,
                                        double tolerance_m,
                                        const std::string& name) const {
  if (!is_sound(point_m)) {
    return Error{ErrorCode::kInvalidValue, "path: the " + name + " must be within 1e6 m"};
  }
  const Cell cell = search_.geometry().cell_at(point_m);
  if (search_.is_traversable(cell)) {
    return cell;
  }
  const Result<Cell> nearest = search_.nearest_traversable(cell, tolerance_m);
  if (nearest) {
    return nearest;
  }
  std::string reason = "lies off the map";
  if (search_.geometry().contains(cell)) {
    const double clearance_m = search_.clearance_m(cell);
    const double radius_m = options_.search.robot_radius_m;
    reason = clearance_m <= 0.0 ? "lies in a wall"
             : clearance_m < radius_m
                 ? "lies " + text_of(clearance_m) + " from a wall, the robot's radius is " +
                       text_of(radius_m)
                 : "lies in unknown space";
  }
  return Error{ErrorCode::kInvalidValue,
               "path: the " + name + " " + text_of(point_m) + " " + reason};
}

Result<GridPath> PathPlanner::search_cells(Cell start,
                                           Cell goal,
                                           const std::vector<Vector2d>& route_m,
                                           bool* left_corridor) {
  *left_corridor = false;
  if (!route_m.empty()) {
    std::vector<Vector2d> line_m{search_.geometry().center_of(start)};
    std::copy_if(route_m.begin(), route_m.end(), std::back_inserter(line_m), is_sound);
    line_m.push_back(search_.geometry().center_of(goal));
    std::vector<Cell> line;
    for (const Vector2d& point_m : resampled(line_m, 0.25 * options_.corridor_m)) {
      line.push_back(search_.geometry().cell_at(point_m));
    }
    const int reach_cells = static_cast<int>(options_.corridor_m / search_.geometry().cell_m);
    Result<GridPath> path = search_.find_path_near(line, reach_cells, start, goal);
    if (path) {
      return path;
    }
    *left_corridor = true;
  }
  return guided_path(start, goal);
}

/// The best path near to the way over large cells.
Result<GridPath> PathPlanner::guided_path(Cell start, Cell goal) {
  const auto large_near = [&](Cell cell) {
    const Cell large{cell.x / kCoarseFactor, cell.y / kCoarseFactor};
    return coarse_search_.nearest_traversable(large, 2.0 * coarse_search_.geometry().cell_m);
  };
  const Result<Cell> large_start = large_near(start);
  const Result<Cell> large_goal = large_near(goal);
  if (large_start && large_goal) {
    const Result<GridPath> guide = coarse_search_.find_path(*large_start, *large_goal);
    std::vector<Cell> line;
    for (const Cell large : guide ? guide->cells : std::vector<Cell>{}) {
      line.push_back({large.x * kCoarseFactor + kCoarseFactor / 2,
                      large.y * kCoarseFactor + kCoarseFactor / 2});
    }
    Result<GridPath> path = search_.find_path_near(line, kGuideReach_cells, start, goal);
    if (path) {
      return path;
    }
  }
  return search_.find_path(start, goal);  // Through gaps that large cells do not show.
}

/// Corners of the path that are left when lines replace the cells between them wherever a line is
/// no more expensive.
std::vector<Vector2d> PathPlanner::shortened(const GridPath& path) const {
  const std::vector<std::size_t> corners = corners_of(path.cells);
  const auto cell_at_corner = [&](std::size_t corner) { return path.cells[corners[corner]]; };
  std::vector<Vector2d> points_m{search_.geometry().center_of(path.cells.front())};
  std::size_t from = 0;
  while (from + 1 < corners.size()) {
    std::size_t to = from + 1;
    double cost_m = search_.line_cost_m(cell_at_corner(from), cell_at_corner(to));
    while (to + 1 < corners.size()) {
      const double longer_m =
          cost_m + search_.line_cost_m(cell_at_corner(to), cell_at_corner(to + 1));
      const double line_m = search_.line_cost_m(cell_at_corner(from), cell_at_corner(to + 1));
      if (!(line_m <= longer_m * (1.0 + 1e-9))) {
        break;
      }
      cost_m = line_m;
      ++to;
    }
    points_m.push_back(search_.geometry().center_of(cell_at_corner(to)));
    from = to;
  }
  return points_m;
}

/// The path begins where the robot is and ends at the very goal, unless these had to be moved.
std::vector<Vector2d> PathPlanner::with_exact_ends(const std::vector<Vector2d>& points_m,
                                                   const Vector2d& start_m,
                                                   const Vector2d& goal_m) const {
  const GridGeometry& geometry = search_.geometry();
  const auto is_in_cell_of = [&](const Vector2d& a, const Vector2d& b) {
    return geometry.cell_at(a) == geometry.cell_at(b);
  };
  std::vector<Vector2d> exact{start_m};
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const bool is_start = i == 0 && is_in_cell_of(start_m, points_m[i]);
    const bool is_goal = i + 1 == points_m.size() && is_in_cell_of(goal_m, points_m[i]);
    if (is_goal) {
      exact.push_back(goal_m);
    } else if (!is_start) {
      exact.push_back(points_m[i]);
    }
  }
  return exact;
}

double PathPlanner::least_clearance_m(const std::vector<Vector2d>& points_m) const {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vector2d& point_m : resampled(points_m, search_.geometry().cell_m)) {
    least_m = std::min(least_m, search_.clearance_m(search_.geometry().cell_at(point_m)));
  }
  return least_m;
}

}  // namespace cairn
