#include "lpm/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;

/// Lowest magnitude in [low, high].
double least_magnitude(double low, double high) {
  return low > 0.0 ? low : (high < 0.0 ? -high : 0.0);
}

/// A vector left to grow by itself takes up to twice as much.
void resize_exactly(std::size_t size, std::vector<std::uint8_t>* level) {
  level->reserve(size);
  level->resize(size);
}

}  // namespace

bool CorrelativeSearch::is_worse(const Candidate& a, const Candidate& b) {
  return std::tie(a.bound, a.angle, a.y, a.x) < std::tie(b.bound, b.angle, b.y, b.x);
}

void CorrelativeSearch::prepare(const DistanceField& walls,
                                double hit_sigma_m,
                                const Vector2d& middle,
                                double reach_m) {
  const GridGeometry& whole = walls.geometry();
  const auto clamped = [&whole](const Vector2d& p) {
    const Vector2d cells = (p - whole.origin_m) / whole.cell_m;
    return Cell{static_cast<int>(std::clamp(cells.x(), 0.0, 1.0 * whole.width)),
                static_cast<int>(std::clamp(cells.y(), 0.0, 1.0 * whole.height))};
  };
  const Cell low = clamped(middle - Vector2d::Constant(reach_m));
  const Cell high = clamped(middle + Vector2d::Constant(reach_m));
  geometry_.cell_m = whole.cell_m;
  geometry_.origin_m = whole.origin_m + whole.cell_m * Vector2d(low.x, low.y);
  geometry_.width = high.x - low.x;
  geometry_.height = high.y - low.y;
  take_walls(walls, hit_sigma_m, low);
  for (int level = 1; level < kLevels; ++level) {
    raise_level(level);
  }
  for (int level = 1; level < kLevels; ++level) {
    widen_level(level);
  }
}

/// A search all around needs a hundred times as much as one nearby, and is as much seldomer.
template <class T>
void CorrelativeSearch::give_back(std::vector<T>* scratch) {
  if (scratch->capacity() * sizeof(T) > kMostScratchBytes) {
    *scratch = {};
  }
}

std::size_t CorrelativeSearch::memory_bytes() const {
  std::size_t bytes = points_.capacity() * sizeof(Cell) + open_.capacity() * sizeof(Candidate);
  for (const std::vector<std::uint8_t>& level : pyramid_) {
    bytes += level.capacity();
  }
  return bytes;
}

void CorrelativeSearch::take_walls(const DistanceField& walls, double hit_sigma_m, Cell low) {
  std::array<std::uint8_t, DistanceField::kFar + 1> likelihood{};
  const double sigma_cells = hit_sigma_m / geometry_.cell_m;
  for (std::size_t squared = 0; squared < DistanceField::kFar; ++squared) {
    const double exponent = -0.5 * static_cast<double>(squared) / (sigma_cells * sigma_cells);
    likelihood[squared] = static_cast<std::uint8_t>(std::lround(kFullScore * std::exp(exponent)));
  }
  resize_exactly(geometry_.cell_count(), &pyramid_[0]);
  widths_[0] = geometry_.width;
  for (int y = 0; y < geometry_.height && geometry_.width > 0; ++y) {
    walls.look_up({low.x, low.y + y}, geometry_.width, likelihood,
                  pyramid_[0].data() + geometry_.index_of({0, y}));
  }
}

/// Maxima over the cells of the level below, two by two.
void CorrelativeSearch::raise_level(int level) {
  const auto at = static_cast<std::size_t>(level);
  const int below_width = widths_[at - 1];
  const int below_height = height_of(level - 1);
  const int width = (below_width + 1) / 2;
  const int height = height_of(level);
  widths_[at] = width;
  resize_exactly(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), &pyramid_[at]);
  std::uint8_t* here = pyramid_[at].data();
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* const lower =
        pyramid_[at - 1].data() + static_cast<std::ptrdiff_t>(2 * y) * below_width;
    const std::uint8_t* const upper = 2 * y + 1 < below_height ? lower + below_width : lower;
    for (int x = 0; x < width; ++x) {
      const int left = 2 * x;
      const int right = std::min(left + 1, below_width - 1);
      *here++ = std::max(std::max(lower[left], lower[right]), std::max(upper[left], upper[right]));
    }
  }
}

/// From maxima over blocks to those over each block and its neighbours to the right and above.
void CorrelativeSearch::widen_level(int level) {
  const auto at = static_cast<std::size_t>(level);
  const int width = widths_[at];
  const int height = height_of(level);
  for (int y = 0; y < height; ++y) {
    std::uint8_t* const row = pyramid_[at].data() + static_cast<std::ptrdiff_t>(y) * width;
    const std::uint8_t* const above = y + 1 < height ? row + width : row;
    for (int x = 0; x < width; ++x) {
      const int right = std::min(x + 1, width - 1);
      row[x] = std::max(std::max(row[x], row[right]), std::max(above[x], above[right]));
    }
  }
}

SearchResult CorrelativeSearch::find(const std::vector<SurfacePoint>& points,
                                     const SearchWindow& window) {
  if (points.empty() || geometry_.cell_count() == 0) {
    return {window.center, 0.0};
  }
  place_points(points, window);
  open_.clear();
  best_ = {};
  best_.bound = -1e300;
  push({0, 0, 0, 0, 0.0}, window);  // the centre is the one to beat
  const Candidate center = open_.back();
  open_.clear();
  best_ = center;
  const int block = 1 << (kLevels - 1);
  for (int angle = -angle_count_; angle <= angle_count_; ++angle) {
    for (int y = -range_cells_; y <= range_cells_; y += block) {
      for (int x = -range_cells_; x <= range_cells_; x += block) {
        push({angle, x, y, kLevels - 1, 0.0}, window);
      }
    }
  }
  // The best last, so that it is taken first; equal ones in a fixed order.
  std::sort(open_.begin(), open_.end(), is_worse);
  while (!open_.empty()) {
    const Candidate next = open_.back();
    open_.pop_back();
    branch(next, window);
  }
  SearchResult result;
  result.pose = Pose2(window.center.x() + best_.x * geometry_.cell_m,
                      window.center.y() + best_.y * geometry_.cell_m,
                      window.center.theta() + best_.angle * angle_step_rad_);
  result.score = likelihood_sum(best_) / (kFullScore * static_cast<double>(point_count_));
  give_back(&points_);
  give_back(&open_);
  return result;
}

void CorrelativeSearch::place_points(const std::vector<SurfacePoint>& points,
                                     const SearchWindow& window) {
  double farthest_m = 1.0;
  for (const SurfacePoint& point : points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  const int step = 1 << window.step_level;
  const double step_m = geometry_.cell_m * step;
  constexpr int kMaxAngles = 2'000;
  const int wanted = static_cast<int>(std::ceil(window.turn_rad * farthest_m / step_m));
  angle_count_ = std::clamp(wanted, 0, kMaxAngles);
  angle_step_rad_ = angle_count_ > 0 ? window.turn_rad / angle_count_ : 0.0;
  range_cells_ = step * static_cast<int>(std::ceil(window.range_m / step_m));
  point_count_ = points.size();
  points_.clear();
  for (int angle = -angle_count_; angle <= angle_count_; ++angle) {
    const Pose2 pose(window.center.translation(), window.center.theta() + angle * angle_step_rad_);
    const double c = std::cos(pose.theta());
    const double s = std::sin(pose.theta());
    for (const auto& [p, normal] : points) {
      points_.push_back(
          geometry_.cell_at({pose.x() + c * p.x() - s * p.y(), pose.y() + s * p.x() + c * p.y()}));
    }
  }
}

double CorrelativeSearch::likelihood_sum(const Candidate& block) const {
  const auto at = static_cast<std::size_t>(block.level);
  const std::uint8_t* const level = pyramid_[at].data();
  const int width = widths_[at];
  const int last = (1 << block.level) - 1;
  const auto first = static_cast<std::size_t>(block.angle + angle_count_) * point_count_;
  std::int64_t sum = 0;
  for (std::size_t i = first; i < first + point_count_; ++i) {
    const int x = points_[i].x + block.x;
    const int y = points_[i].y + block.y;
    if (x + last < 0 || y + last < 0 || x >= geometry_.width || y >= geometry_.height) {
      continue;
    }
    // A block that begins left of or below the grid is held by the first ones of the grid.
    const int column = std::max(x, 0) >> block.level;
    const int row = std::max(y, 0) >> block.level;
    sum += level[static_cast<std::ptrdiff_t>(row) * width + column];
  }
  return static_cast<double>(sum);
}

double CorrelativeSearch::bound_of(const Candidate& block, const SearchWindow& window) const {
  const int last = (1 << block.level) - 1;
  const double dx = least_magnitude(block.x, block.x + last) * geometry_.cell_m / window.sigma_m;
  const double dy = least_magnitude(block.y, block.y + last) * geometry_.cell_m / window.sigma_m;
  const double turn = block.angle * angle_step_rad_ / window.sigma_rad;
  // A point on a wall is worth 2, as one of two sigmas off would cost in squares.
  const double worth = 2.0 * window.independent_share / kFullScore;
  return worth * likelihood_sum(block) - 0.5 * (dx * dx + dy * dy + turn * turn);
}

void CorrelativeSearch::push(Candidate block, const SearchWindow& window) {
  if (block.x > range_cells_ || block.y > range_cells_) {
    return;
  }
  block.bound = bound_of(block, window);
  if (block.bound > best_.bound) {
    open_.push_back(block);
  }
}

void CorrelativeSearch::branch(const Candidate& block, const SearchWindow& window) {
  if (block.bound <= best_.bound) {
    return;
  }
  if (block.level == window.step_level) {
    Candidate leaf = block;
    leaf.level = 0;
    leaf.bound = bound_of(leaf, window);
    if (leaf.bound > best_.bound) {
      best_ = leaf;
    }
    return;
  }
  const std::size_t first = open_.size();
  const int half = 1 << (block.level - 1);
  for (const int dy : {0, half}) {
    for (const int dx : {0, half}) {
      push({block.angle, block.x + dx, block.y + dy, block.level - 1, 0.0}, window);
    }
  }
  std::sort(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end(), is_worse);
}

}  // namespace cairn
