#include "grid/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

using Squared = std::int64_t;
constexpr Squared kFar = std::numeric_limits<std::int32_t>::max();

/// Rows of this height above the line are compared: the lower envelope of the parabolas
/// (x - position)^2 + height.
struct Envelope {
  std::vector<int> position;  ///< Of the parabolas in the envelope, ascending.
  std::vector<double> start;  ///< Where each of them begins to be the lowest.
};

/// Where the parabola at `q` gets below the one at `p`, for p < q.
double intersection(int p, Squared height_p, int q, Squared height_q) {
  const Squared rise = height_q + Squared{q} * q - height_p - Squared{p} * p;
  // Between neighbours, as most are, the same without a division.
  return q - p == 1 ? 0.5 * static_cast<double>(rise) : static_cast<double>(rise) / (2.0 * (q - p));
}

void make_envelope(const std::vector<Squared>& heights, Envelope* envelope) {
  envelope->position.clear();
  envelope->start.clear();
  for (int q = 0; q < static_cast<int>(heights.size()); ++q) {
    const Squared height = heights[static_cast<std::size_t>(q)];
    if (height >= kFar) {
      continue;
    }
    double start = -std::numeric_limits<double>::infinity();
    while (!envelope->position.empty()) {
      const int p = envelope->position.back();
      start = intersection(p, heights[static_cast<std::size_t>(p)], q, height);
      if (start > envelope->start.back()) {
        break;
      }
      envelope->position.pop_back();
      envelope->start.pop_back();
      start = -std::numeric_limits<double>::infinity();
    }
    envelope->position.push_back(q);
    envelope->start.push_back(start);
  }
}

/// The part of a window that lies within the grid.
GridWindow clipped(const GridWindow& window, const GridGeometry& geometry) {
  const int x0 = std::clamp(window.lower.x, 0, geometry.width);
  const int y0 = std::clamp(window.lower.y, 0, geometry.height);
  const int x1 = std::clamp(window.lower.x + std::max(window.width, 0), x0, geometry.width);
  const int y1 = std::clamp(window.lower.y + std::max(window.height, 0), y0, geometry.height);
  return {{x0, y0}, x1 - x0, y1 - y0};
}

/// Vertical distances: for each cell of a column the row of the nearest cell that is not free, or
/// -1.
std::vector<int> nearest_in_columns(const std::vector<CellState>& state, int width, int height) {
  // Row by row, as memory lies.
  std::vector<int> row_of(state.size(), -1);
  std::vector<int> last(static_cast<std::size_t>(width), -1);
  std::size_t index = 0;
  for (int y = 0; y < height; ++y) {
    for (int& row : last) {
      row = state[index] != CellState::kFree ? y : row;
      row_of[index++] = row;
    }
  }
  std::fill(last.begin(), last.end(), -1);
  for (int y = height - 1; y >= 0; --y) {
    index = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int& row : last) {
      row = state[index] != CellState::kFree ? y : row;
      int& nearest = row_of[index++];
      if (row >= 0 && (nearest < 0 || row - y < y - nearest)) {
        nearest = row;
      }
    }
  }
  return row_of;
}

}  // namespace

GridWindow whole_window(const GridGeometry& geometry) {
  return {{0, 0}, geometry.width, geometry.height};
}

CellState DistanceTransform::state(Cell c) const {
  return window_.contains(c) ? state_[index_of(c)] : CellState::kUnknown;
}

std::int32_t DistanceTransform::squared_clearance_cells(Cell c) const {
  CAIRN_CHECK(window_.contains(c));
  return squared_cells_[index_of(c)];
}

double DistanceTransform::clearance_m(Cell c) const {
  if (!window_.contains(c)) {
    return 0.0;
  }
  const std::int32_t squared = squared_cells_[index_of(c)];
  return squared == kUnbounded ? std::numeric_limits<double>::infinity()
                               : geometry_.cell_m * std::sqrt(static_cast<double>(squared));
}

Cell DistanceTransform::basis_point(Cell c) const {
  CAIRN_CHECK(window_.contains(c));
  const std::int32_t basis = basis_[index_of(c)];
  return {window_.lower.x + basis % window_.width, window_.lower.y + basis / window_.width};
}

DistanceTransform distance_transform(const OccupancyGrid& grid, const GridWindow& window) {
  DistanceTransform result;
  result.geometry_ = grid.geometry();
  result.window_ = clipped(window, grid.geometry());
  const GridWindow& w = result.window_;
  const std::size_t count = static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height);
  result.state_.reserve(count);
  for (int y = 0; y < w.height; ++y) {
    for (int x = 0; x < w.width; ++x) {
      result.state_.push_back(grid.state({w.lower.x + x, w.lower.y + y}));
    }
  }
  result.squared_cells_.assign(count, DistanceTransform::kUnbounded);
  result.basis_.resize(count);

  const std::vector<int> row_of = nearest_in_columns(result.state_, w.width, w.height);
  std::vector<Squared> heights(static_cast<std::size_t>(w.width));
  Envelope envelope;
  std::size_t index = 0;
  for (int y = 0; y < w.height; ++y) {
    const std::size_t row = index;
    for (std::size_t x = 0; x < heights.size(); ++x) {
      const int nearest = row_of[row + x];
      heights[x] = nearest < 0 ? kFar : Squared{nearest - y} * (nearest - y);
    }
    make_envelope(heights, &envelope);
    std::size_t k = 0;
    for (int x = 0; x < w.width; ++x, ++index) {
      result.basis_[index] = static_cast<std::int32_t>(index);
      if (envelope.position.empty()) {
        continue;
      }
      while (k + 1 < envelope.position.size() && envelope.start[k + 1] < x) {
        ++k;
      }
      const int p = envelope.position[k];
      const Squared squared = Squared{x - p} * (x - p) + heights[static_cast<std::size_t>(p)];
      result.squared_cells_[index] = static_cast<std::int32_t>(squared);
      result.basis_[index] = row_of[row + static_cast<std::size_t>(p)] * w.width + p;
    }
  }
  return result;
}

DistanceTransform distance_transform(const OccupancyGrid& grid) {
  return distance_transform(grid, whole_window(grid.geometry()));
}

}  // namespace cairn
