#include "grid/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/check.hpp"

namespace cairn {
namespace {

// A step costs its length times the weights of both its cells; 17 / 12 is the root of two.
constexpr std::uint32_t kStraight = 12;
constexpr std::uint32_t kDiagonal = 17;
constexpr std::uint32_t kOpenWeight = GridSearch::kOpenWeight;
constexpr double kCostPerCell = 2.0 * kOpenWeight * kStraight;
// No way may cost more; a thousand steps are far from overflowing.
constexpr std::uint32_t kMostCost = std::numeric_limits<std::uint32_t>::max() - 10'000'000;

// Estimates that differ by less share a bucket: a sixth of the cost of an open cell.
constexpr std::uint32_t kBucketCost = 64;
// A step adds at most 2 x 255 x 17 to the cost and 2 x 16 x 17 to the estimate of what is left.
constexpr std::uint32_t kBucketCount = 256;
constexpr int kStepBits = 4;  // Eight steps, and none for the start.
constexpr std::uint32_t kNoStep = 8;

struct Step {
  int dx = 0;
  int dy = 0;
};
// Each diagonal follows from two straight steps: number 4 + i from i and (i + 1) % 4.
constexpr std::array<Step, 8> kSteps = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// Least cost between two cells of an open grid.
std::uint32_t least_cost(Cell from, Cell to) {
  const auto dx = static_cast<std::uint32_t>(std::abs(to.x - from.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(to.y - from.y));
  const std::uint32_t diagonal = std::min(dx, dy);
  return 2 * kOpenWeight * (kStraight * (std::max(dx, dy) - diagonal) + kDiagonal * diagonal);
}

std::string text_of(Cell cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

/// Calls `visit` with the first cell and the length of every row of a disc within the grid.
template <typename Visit>
void for_rows_of_disc(const GridGeometry& geometry, Cell center, int reach_cells, Visit visit) {
  const int lower = std::max(0, center.y - reach_cells);
  const int upper = std::min(geometry.height - 1, center.y + reach_cells);
  for (int y = lower; y <= upper; ++y) {
    const double dy = y - center.y;
    const int half = static_cast<int>(std::sqrt(1.0 * reach_cells * reach_cells - dy * dy));
    const int first = std::max(0, center.x - half);
    const int last = std::min(geometry.width - 1, center.x + half);
    if (first <= last) {
      visit(Cell{first, y}, last - first + 1);
    }
  }
}

}  // namespace

GridSearch::GridSearch(const GridGeometry& geometry)
    : geometry_(geometry),
      stride_(static_cast<std::uint32_t>(geometry.width) + 2),
      buckets_(kBucketCount) {
  const std::size_t count = stride_ * (static_cast<std::size_t>(geometry.height) + 2);
  CAIRN_CHECK(count < std::numeric_limits<std::uint32_t>::max());
  tenths_clearance_.resize(count);
  weight_.resize(count);
  near_weight_.resize(count);
  nodes_.resize(count);
}

GridSearch::GridSearch(const OccupancyGrid& grid, const GridSearchOptions& options)
    : GridSearch(grid.geometry()) {
  CAIRN_CHECK(validate(options).ok());
  measure_clearance(grid);
  set_weights(grid, options);
}

bool GridSearch::is_traversable(Cell cell) const {
  return geometry_.contains(cell) && weight_[index_of(cell)] != 0;
}

double GridSearch::clearance_m(Cell cell) const {
  return geometry_.contains(cell) ? 0.1 * geometry_.cell_m * tenths_clearance_[index_of(cell)]
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
    weights += weight_[index_of(cell)];
  }
  const double mean_weight = static_cast<double>(weights) / (samples + 1.0) / kOpenWeight;
  return geometry_.cell_m * std::hypot(to.x - from.x, to.y - from.y) * mean_weight;
}

Result<GridPath> GridSearch::find_path(Cell from, Cell to) {
  return search(weight_, from, to);
}

Result<GridPath> GridSearch::find_path_near(const std::vector<Cell>& line,
                                            int reach_cells,
                                            Cell from,
                                            Cell to) {
  for (const Cell cell : line) {
    copy_weights(cell, reach_cells);
  }
  copy_weights(from, reach_cells);
  copy_weights(to, reach_cells);
  Result<GridPath> path = search(near_weight_, from, to);
  for (const Cell cell : line) {
    clear_weights(cell, reach_cells);
  }
  clear_weights(from, reach_cells);
  clear_weights(to, reach_cells);
  return path;
}

void GridSearch::copy_weights(Cell center, int reach_cells) {
  for_rows_of_disc(geometry_, center, reach_cells, [&](Cell first, int length) {
    std::copy_n(weight_.data() + index_of(first), length, near_weight_.data() + index_of(first));
  });
}

void GridSearch::clear_weights(Cell center, int reach_cells) {
  for_rows_of_disc(geometry_, center, reach_cells, [&](Cell first, int length) {
    std::fill_n(near_weight_.data() + index_of(first), length, std::uint8_t{0});
  });
}

Result<GridPath> GridSearch::search(const std::vector<std::uint8_t>& weight, Cell from, Cell to) {
  for (const Cell end : {from, to}) {
    if (!is_traversable(end)) {
      return Error{ErrorCode::kInvalidValue,
                   "grid search: cell " + text_of(end) + " is not traversable"};
    }
  }
  begin(index_of(from), least_cost(from, to));
  if (!run(weight, index_of(to))) {
    return Error{ErrorCode::kNotFound,
                 "grid search: no way from cell " + text_of(from) + " to cell " + text_of(to)};
  }
  return path_to(index_of(to));
}

void GridSearch::begin(std::uint32_t start, std::uint32_t estimate) {
  if (++search_number_ == (1U << (32 - kStepBits))) {  // All numbers are used: forget everything.
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    search_number_ = 1;
  }
  for (std::vector<Open>& bucket : buckets_) {
    bucket.clear();
  }
  open_count_ = 0;
  bucket_ = estimate / kBucketCost;
  nodes_[start] = {0, search_number_ << kStepBits | kNoStep};
  open(estimate, {0, start});
}

void GridSearch::open(std::uint32_t estimate, const Open& node) {
  buckets_[estimate / kBucketCost % kBucketCount].push_back(node);
  ++open_count_;
}

/// Whether the goal was reached. A way is the cheapest when its whole bucket has been expanded.
bool GridSearch::run(const std::vector<std::uint8_t>& weight, std::uint32_t goal) {
  const Cell goal_cell = cell_of(goal);
  bool is_reached = false;
  while (open_count_ > 0) {
    std::vector<Open>& bucket = buckets_[bucket_ % kBucketCount];
    if (bucket.empty()) {
      if (is_reached) {
        break;
      }
      ++bucket_;
      continue;
    }
    const Open node = bucket.back();
    bucket.pop_back();
    --open_count_;
    if (node.index == goal) {
      is_reached = true;
    } else if (node.cost == nodes_[node.index].cost && node.cost < kMostCost) {
      expand(weight, node, goal_cell);
    }
  }
  return is_reached;
}

void GridSearch::expand(const std::vector<std::uint8_t>& weight, const Open& node, Cell goal) {
  const Cell cell = cell_of(node.index);
  const std::uint32_t own_weight = weight[node.index];
  const auto stride = static_cast<int>(stride_);
  std::array<std::uint32_t, 8> neighbor_weight{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto index = static_cast<std::uint32_t>(static_cast<int>(node.index) +
                                                  kSteps[i].dy * stride + kSteps[i].dx);
    const std::uint32_t next_weight = weight[index];
    neighbor_weight[i] = next_weight;
    // Nothing may cut a corner: a diagonal needs both cells beside it.
    if (next_weight == 0 ||
        (i >= 4 && (neighbor_weight[i - 4] == 0 || neighbor_weight[(i - 3) % 4] == 0))) {
      continue;
    }
    const std::uint32_t cost =
        node.cost + (i >= 4 ? kDiagonal : kStraight) * (own_weight + next_weight);
    Node& known = nodes_[index];
    if (known.mark >> kStepBits == search_number_ && known.cost <= cost) {
      continue;
    }
    known = {cost, search_number_ << kStepBits | i};
    open(cost + least_cost({cell.x + kSteps[i].dx, cell.y + kSteps[i].dy}, goal), {cost, index});
  }
}

GridPath GridSearch::path_to(std::uint32_t index) const {
  GridPath path;
  path.cost_m = geometry_.cell_m * nodes_[index].cost / kCostPerCell;
  Cell cell = cell_of(index);
  path.cells.push_back(cell);
  while (true) {
    const std::uint32_t step = nodes_[index_of(cell)].mark % (1U << kStepBits);
    if (step == kNoStep) {
      break;
    }
    cell = {cell.x - kSteps[step].dx, cell.y - kSteps[step].dy};
    path.length_m += geometry_.cell_m * (step >= 4 ? std::sqrt(2.0) : 1.0);
    path.cells.push_back(cell);
  }
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
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
