#include "lpm/wall_segments.hpp"

#include <algorithm>
#include <cmath>

#include "lpm/surface_points.hpp"

namespace cairn {
namespace {

constexpr double kLeastSpread_m = 0.005;  // no laser is better

/// Returns [first, last] of the scan.
using Stretch = std::pair<std::size_t, std::size_t>;

/// Moments of a stretch around its middle.
WallSegment fitted(const std::vector<SurfacePoint>& points, const Stretch& stretch) {
  const auto count = static_cast<double>(stretch.second - stretch.first + 1);
  Vector2d middle = Vector2d::Zero();
  for (std::size_t i = stretch.first; i <= stretch.second; ++i) {
    middle += points[i].p / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = stretch.first; i <= stretch.second; ++i) {
    const Vector2d off = points[i].p - middle;
    xx += off.x() * off.x();
    xy += off.x() * off.y();
    yy += off.y() * off.y();
  }
  const double direction_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double along2 = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  const double across2 = std::max(xx + yy - along2, 0.0);
  const double spread2 =
      std::max(across2 / std::max(count - 2.0, 1.0), kLeastSpread_m * kLeastSpread_m);
  WallSegment segment;
  segment.direction_rad = direction_rad;
  segment.length_m = (points[stretch.second].p - points[stretch.first].p).norm();
  segment.sigma_rad = std::sqrt(spread2 / along2);
  return segment;
}

/// The return farthest off the line through the ends, and how far.
std::pair<std::size_t, double> farthest_off(const std::vector<SurfacePoint>& points,
                                            const Stretch& stretch) {
  const Vector2d from = points[stretch.first].p;
  const Vector2d along = points[stretch.second].p - from;
  const double length_m = along.norm();
  std::pair<std::size_t, double> farthest{stretch.first, 0.0};
  for (std::size_t i = stretch.first; i <= stretch.second; ++i) {
    const Vector2d off = points[i].p - from;
    const double off_m = length_m > 0.0
                             ? std::abs(along.x() * off.y() - along.y() * off.x()) / length_m
                             : off.norm();
    if (off_m > farthest.second) {
      farthest = {i, off_m};
    }
  }
  return farthest;
}

}  // namespace

const std::vector<WallSegment>& WallSegmenter::split(const ScanBeams& beams) {
  surface_points_of(beams, 0.0, options_.max_range_m, &points_);
  open_.clear();
  segments_.clear();
  std::size_t end = points_.size();
  for (std::size_t i = points_.size(); i-- > 0;) {
    const bool begins =
        i == 0 || (points_[i].p - points_[i - 1].p).norm() > options_.greatest_gap_m;
    if (begins) {
      open_.emplace_back(i, end - 1);
      end = i;
    }
  }
  while (!open_.empty()) {
    const Stretch stretch = open_.back();
    open_.pop_back();
    if (stretch.second - stretch.first + 1 < static_cast<std::size_t>(options_.least_returns)) {
      continue;
    }
    const auto [corner, off_m] = farthest_off(points_, stretch);
    if (off_m > 2.0 * options_.flatness_m) {
      open_.emplace_back(corner, stretch.second);
      open_.emplace_back(stretch.first, corner);
      continue;
    }
    const WallSegment segment = fitted(points_, stretch);
    if (segment.length_m >= options_.least_length_m) {
      segments_.push_back(segment);
    }
  }
  return segments_;
}

}  // namespace cairn
