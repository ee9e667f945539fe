#include "lpm/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/check.hpp"

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;

/// Lowest magnitude in [low, high].
double least_magnitude(double low, double high) {
  return low > 0.0 ? low : (high < 0.0 ? -high : 0.0);
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
  pyramid_.resize(kLevels);
  take_walls(walls, hit_sigma_m, low);
  for (int level = 1; level < kLevels; ++level) {
    raise_level(level);
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
  pyramid_[0].resize(geometry_.cell_count());
  for (int y = 0; y < geometry_.height && geometry_.width > 0; ++y) {
    const std::uint8_t* const from =
        walls.squared().data() + walls.geometry().index_of({low.x, low.y + y});
    std::uint8_t* const row = pyramid_[0].data() + geometry_.index_of({0, y});
    std::transform(from, from + geometry_.width, row,
                   [&](std::uint8_t squared) { return likelihood[squared]; });
  }
}

void CorrelativeSearch::raise_level(int level) {
  const int width = geometry_.width;
  const int height = geometry_.height;
  const int half = 1 << (level - 1);
  const std::vector<std::uint8_t>& below = pyramid_[static_cast<std::size_t>(level - 1)];
  std::vector<std::uint8_t>& here = pyramid_[static_cast<std::size_t>(level)];
  here.resize(below.size());
  for (int y = 0; y < height && width > 0; ++y) {
    const std::uint8_t* const lower = below.data() + geometry_.index_of({0, y});
    const bool has_upper = y + half < height;
    const std::uint8_t* const upper = has_upper ? lower + half * width : lower;
    std::uint8_t* const row = here.data() + geometry_.index_of({0, y});
    for (int x = 0; x + half < width; ++x) {
      row[x] = std::max(std::max(lower[x], lower[x + half]), std::max(upper[x], upper[x + half]));
    }
    for (int x = std::max(0, width - half); x < width; ++x) {
      row[x] = std::max(lower[x], upper[x]);
    }
  }
}

SearchResult CorrelativeSearch::find(const std::vector<SurfacePoint>& points,
                                     const SearchWindow& window) {
  CAIRN_CHECK(!pyramid_.empty());
  if (points.empty()) {
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
  return result;
}

void CorrelativeSearch::place_points(const std::vector<SurfacePoint>& points,
                                     const SearchWindow& window) {
  double farthest_m = 1.0;
  for (const SurfacePoint& point : points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  constexpr int kMaxAngles = 2'000;
  const int wanted = static_cast<int>(std::ceil(window.turn_rad * farthest_m / geometry_.cell_m));
  angle_count_ = std::clamp(wanted, 0, kMaxAngles);
  angle_step_rad_ = angle_count_ > 0 ? window.turn_rad / angle_count_ : 0.0;
  range_cells_ = static_cast<int>(std::ceil(window.range_m / geometry_.cell_m));
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
  const std::vector<std::uint8_t>& level = pyramid_[static_cast<std::size_t>(block.level)];
  const auto first = static_cast<std::size_t>(block.angle + angle_count_) * point_count_;
  const int size = 1 << block.level;
  std::int64_t sum = 0;
  for (std::size_t i = first; i < first + point_count_; ++i) {
    int x = points_[i].x + block.x;
    int y = points_[i].y + block.y;
    if (x <= -size || y <= -size || x >= geometry_.width || y >= geometry_.height) {
      continue;
    }
    // A block that begins left of or below the grid is bounded by the one at its border.
    x = std::max(x, 0);
    y = std::max(y, 0);
    sum += level[geometry_.index_of({x, y})];
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
  if (block.level == 0) {
    best_ = block;
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
