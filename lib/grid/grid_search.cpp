#include "grid/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "grid/distance_transform.hpp"

namespace cairn {
namespace {

constexpr std::uint32_t kOpenWeight = 16;
// A step costs its length times the weights of both its cells; 17 / 12 is the root of two.
constexpr std::uint32_t kStraight = 12;
constexpr std::uint32_t kDiagonal = 17;
constexpr double kCostPerCell = 2.0 * kOpenWeight * kStraight;
// No way may cost more; a thousand steps are far from overflowing.
constexpr std::uint32_t kMostCost = std::numeric_limits<std::uint32_t>::max() - 10'000'000;

struct Step {
  int dx = 0;
  int dy = 0;
};
constexpr std::array<Step, 8> kSteps = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// Least cost between two cells of an open grid.
std::uint32_t least_cost(Cell from, Cell to) {
  const auto dx = static_cast<std::uint32_t>(std::abs(to.x - from.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(to.y - from.y));
  return 2 * kOpenWeight *
         (kStraight * (std::max(dx, dy) - std::min(dx, dy)) + kDiagonal * std::min(dx, dy));
}

/// Max-heap order that gives the least estimate; among those the one nearest to the goal, then the
/// lower cell.
constexpr auto kIsWorse = [](const auto& a, const auto& b) {
  if (a.estimate != b.estimate) {
    return a.estimate > b.estimate;
  }
  return a.cost != b.cost ? a.cost < b.cost : a.index > b.index;
};

std::string text_of(Cell cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

}  // namespace

Status validate(const GridSearchOptions& options) {
  return Validator("grid_search")
      .within("robot_radius_m", options.robot_radius_m, 0.0, 10.0)
      .within("comfort_clearance_m", options.comfort_clearance_m, 0.0, 10.0)
      .within("wall_cost", options.wall_cost, 0.0, 14.0)
      .status();
}

GridSearch::GridSearch(const OccupancyGrid& grid, const GridSearchOptions& options)
    : geometry_(grid.geometry()), nodes_(grid.geometry().cell_count()) {
  CAIRN_CHECK(validate(options).ok());
  measure_clearance(grid);
  set_weights(grid, options);
}

void GridSearch::measure_clearance(const OccupancyGrid& grid) {
  OccupancyGrid walls = grid;
  for (OccupancyGrid::LogOdds& value : walls.cells()) {
    if (value <= OccupancyGrid::kOccupiedAbove) {
      value = OccupancyGrid::kFreeBelow - 1;
    }
  }
  const DistanceTransform distances = distance_transform(walls);
  tenths_clearance_.reserve(geometry_.cell_count());
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const double cells = std::sqrt(distances.squared_clearance_cells({x, y}));
      tenths_clearance_.push_back(
          static_cast<std::uint8_t>(std::min(255L, std::lround(10.0 * cells))));
    }
  }
}

void GridSearch::set_weights(const OccupancyGrid& grid, const GridSearchOptions& options) {
  weight_.resize(geometry_.cell_count());
  const double margin_m = options.comfort_clearance_m - options.robot_radius_m;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const double clearance = 0.1 * geometry_.cell_m * tenths_clearance_[i];
    const bool is_known = grid.cells()[i] < OccupancyGrid::kFreeBelow;
    if (tenths_clearance_[i] == 0 || clearance < options.robot_radius_m ||
        !(is_known || options.unknown_is_traversable)) {
      continue;
    }
    const double nearness =
        margin_m > 0.0 ? std::max(0.0, (options.comfort_clearance_m - clearance) / margin_m) : 0.0;
    weight_[i] = static_cast<std::uint8_t>(
        std::lround(kOpenWeight * (1.0 + options.wall_cost * std::min(1.0, nearness))));
  }
}

bool GridSearch::is_traversable(Cell cell) const {
  return geometry_.contains(cell) && weight_[geometry_.index_of(cell)] != 0;
}

double GridSearch::clearance_m(Cell cell) const {
  return geometry_.contains(cell)
             ? 0.1 * geometry_.cell_m * tenths_clearance_[geometry_.index_of(cell)]
             : 0.0;
}

double GridSearch::line_cost_m(Cell from, Cell to) const {
  const int samples = 2 * std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  std::uint64_t weights = 0;
  for (int i = 0; i <= samples; ++i) {
    const double share = samples == 0 ? 0.0 : static_cast<double>(i) / samples;
    const Cell cell{from.x + static_cast<int>(std::lround(share * (to.x - from.x))),
                    from.y + static_cast<int>(std::lround(share * (to.y - from.y)))};
    if (!is_traversable(cell)) {
      return std::numeric_limits<double>::infinity();
    }
    weights += weight_[geometry_.index_of(cell)];
  }
  const double mean_weight = static_cast<double>(weights) / (samples + 1.0) / kOpenWeight;
  return geometry_.cell_m * std::hypot(to.x - from.x, to.y - from.y) * mean_weight;
}

Result<GridPath> GridSearch::find_path(Cell from, Cell to) {
  return search(from, to, nullptr);
}

Result<GridPath> GridSearch::find_path_within(const std::vector<std::uint8_t>& allowed,
                                              Cell from,
                                              Cell to) {
  CAIRN_CHECK(allowed.size() == geometry_.cell_count());
  return search(from, to, allowed.data());
}

Result<GridPath> GridSearch::search(Cell from, Cell to, const std::uint8_t* allowed) {
  for (const Cell end : {from, to}) {
    if (!is_traversable(end)) {
      return Error{ErrorCode::kInvalidValue,
                   "grid search: cell " + text_of(end) + " is not traversable"};
    }
  }
  const auto goal = static_cast<std::uint32_t>(geometry_.index_of(to));
  begin(static_cast<std::uint32_t>(geometry_.index_of(from)), least_cost(from, to));
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), kIsWorse);
    const Open node = open_.back();
    open_.pop_back();
    if (node.index == goal) {
      return path_to(goal);
    }
    if (node.cost == nodes_[node.index].cost && node.cost < kMostCost) {
      expand(node, to, allowed);
    }
  }
  return Error{ErrorCode::kNotFound,
               "grid search: no way from cell " + text_of(from) + " to cell " + text_of(to)};
}

void GridSearch::begin(std::uint32_t start, std::uint32_t estimate) {
  if (++search_number_ == 0) {  // After 2^32 searches all nodes are stale again.
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    search_number_ = 1;
  }
  open_.clear();
  nodes_[start] = {0, search_number_, start};
  open_.push_back({estimate, 0, start});
}

void GridSearch::expand(const Open& node, Cell goal, const std::uint8_t* allowed) {
  const Cell cell = cell_of(node.index);
  const std::uint32_t weight = weight_[node.index];
  for (const Step step : kSteps) {
    const Cell next{cell.x + step.dx, cell.y + step.dy};
    if (!is_traversable(next)) {
      continue;
    }
    const bool is_diagonal = step.dx != 0 && step.dy != 0;
    if (is_diagonal && !(is_traversable({next.x, cell.y}) && is_traversable({cell.x, next.y}))) {
      continue;  // Would cut a corner.
    }
    const auto index = static_cast<std::uint32_t>(geometry_.index_of(next));
    if (allowed != nullptr && allowed[index] == 0) {
      continue;
    }
    const std::uint32_t cost =
        node.cost + (is_diagonal ? kDiagonal : kStraight) * (weight + weight_[index]);
    Node& known = nodes_[index];
    if (known.search == search_number_ && known.cost <= cost) {
      continue;
    }
    known = {cost, search_number_, node.index};
    open_.push_back({cost + least_cost(next, goal), cost, index});
    std::push_heap(open_.begin(), open_.end(), kIsWorse);
  }
}

GridPath GridSearch::path_to(std::uint32_t index) const {
  GridPath path;
  path.cost_m = geometry_.cell_m * nodes_[index].cost / kCostPerCell;
  path.cells.push_back(cell_of(index));
  while (nodes_[index].parent != index) {
    index = nodes_[index].parent;
    const Cell cell = cell_of(index);
    const Cell after = path.cells.back();
    path.length_m += geometry_.cell_m * std::hypot(after.x - cell.x, after.y - cell.y);
    path.cells.push_back(cell);
  }
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
}

Cell GridSearch::cell_of(std::uint32_t index) const {
  const auto width = static_cast<std::uint32_t>(geometry_.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

Result<Cell> GridSearch::nearest_traversable(Cell cell, double radius_m) const {
  const double reach_cells = std::clamp(radius_m / geometry_.cell_m, 0.0, 1e4);
  const int reach = static_cast<int>(reach_cells);
  int least_squared = std::numeric_limits<int>::max();
  Cell nearest;
  const int lower_x = std::max(0, cell.x - reach);
  const int upper_x = std::min(geometry_.width - 1, cell.x + reach);
  for (int y = std::max(0, cell.y - reach); y <= std::min(geometry_.height - 1, cell.y + reach);
       ++y) {
    for (int x = lower_x; x <= upper_x; ++x) {
      const int squared = (x - cell.x) * (x - cell.x) + (y - cell.y) * (y - cell.y);
      if (squared < least_squared && squared <= reach_cells * reach_cells &&
          is_traversable({x, y})) {
        least_squared = squared;
        nearest = {x, y};
      }
    }
  }
  if (least_squared == std::numeric_limits<int>::max()) {
    return Error{ErrorCode::kNotFound,
                 "grid search: nothing traversable near cell " + text_of(cell)};
  }
  return nearest;
}

}  // namespace cairn
