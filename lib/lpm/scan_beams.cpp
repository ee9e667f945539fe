#include "lpm/scan_beams.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kPatch_m = 0.20;      // half the length of surface that a normal is taken from
constexpr std::size_t kMostBeams = 8;  // on either side
constexpr double kNeighbour_m = 1.0;   // farther returns are no neighbours on a surface
constexpr double kEdge = 3.0;          // ratio of distances to neighbours across an edge

}  // namespace

void ScanBeams::take(const LaserScan& scan, const Twist& twist, double max_free_range_m) {
  turn_to(scan);
  returns_.clear();
  origins_.clear();
  numbers_.clear();
  ranges_m_.clear();
  free_beams_.clear();
  const std::size_t beams = scan.ranges_m.size();
  const double beam_s = beams > 1 ? scan.sweep_duration_s / static_cast<double>(beams - 1) : 0.0;
  const double free_m = std::min(scan.max_range_m, max_free_range_m);
  Pose2 T_first_laser = scan.T_robot_laser;
  double c = std::cos(T_first_laser.theta());
  double s = std::sin(T_first_laser.theta());
  for (std::size_t i = 0; i < beams; ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      continue;
    }
    if (beam_s > 0.0) {
      const double t_s = static_cast<double>(i) * beam_s;
      T_first_laser =
          Pose2(twist.ahead_m_per_s * t_s, twist.left_m_per_s * t_s, twist.turn_rad_per_s * t_s) *
          scan.T_robot_laser;
      c = std::cos(T_first_laser.theta());
      s = std::sin(T_first_laser.theta());
    }
    const Vector2d from = T_first_laser.translation();
    const Vector2d& way = directions_[i];
    const Vector2d along(c * way.x() - s * way.y(), s * way.x() + c * way.y());
    if (range_m <= scan.max_range_m) {
      returns_.push_back({from + range_m * along, Vector2d::Zero()});
      origins_.push_back(from);
      numbers_.push_back(static_cast<std::uint32_t>(i));
      ranges_m_.push_back(scan.ranges_m[i]);
    } else {
      free_beams_.push_back({from, from + free_m * along});
    }
  }
  find_normals();
}

void ScanBeams::turn_to(const LaserScan& scan) {
  if (scan.bearings_rad == bearings_rad_) {
    return;
  }
  bearings_rad_ = scan.bearings_rad;
  const auto [low, high] = std::minmax_element(bearings_rad_.begin(), bearings_rad_.end());
  spacing_rad_ = bearings_rad_.size() > 1 ? static_cast<double>(*high - *low) /
                                                static_cast<double>(bearings_rad_.size() - 1)
                                          : 0.0;
  directions_.resize(bearings_rad_.size());
  std::transform(bearings_rad_.begin(), bearings_rad_.end(), directions_.begin(),
                 [](float bearing_rad) {
                   const double angle_rad = static_cast<double>(bearing_rad);
                   return Vector2d(std::cos(angle_rad), std::sin(angle_rad));
                 });
}

void ScanBeams::find_normals() {
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    const Vector2d normal = normal_at(i);
    returns_[i].normal = normal.dot(returns_[i].p - origins_[i]) > 0.0 ? Vector2d(-normal) : normal;
  }
}

/// Across the line through the neighbours on the same surface.
Vector2d ScanBeams::normal_at(std::size_t i) const {
  const Vector2d p = returns_[i].p;
  constexpr double kNeighbour_m2 = kNeighbour_m * kNeighbour_m;
  constexpr double kEdge2 = kEdge * kEdge;
  const auto gap_m2 = [this](std::size_t a, std::size_t b) {
    return (returns_[a].p - returns_[b].p).squaredNorm();
  };
  const double before_m2 = i > 0 ? gap_m2(i - 1, i) : kNeighbour_m2;
  const double after_m2 = i + 1 < returns_.size() ? gap_m2(i, i + 1) : kNeighbour_m2;
  // Across an edge the neighbour belongs to another surface.
  std::size_t first = before_m2 < kNeighbour_m2 && before_m2 < kEdge2 * after_m2 ? i - 1 : i;
  std::size_t last = after_m2 < kNeighbour_m2 && after_m2 < kEdge2 * before_m2 ? i + 1 : i;
  if (first == last) {
    return Vector2d::Zero();
  }
  const auto is_on_patch = [&](std::size_t j) {
    return (returns_[j].p - p).squaredNorm() < kPatch_m * kPatch_m;
  };
  while (first < i && first > 0 && i - first < kMostBeams && is_on_patch(first - 1)) {
    --first;
  }
  while (last > i && last + 1 < returns_.size() && last - i < kMostBeams && is_on_patch(last + 1)) {
    ++last;
  }
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  double syy = 0.0;
  for (std::size_t j = first; j <= last; ++j) {
    const Vector2d d = returns_[j].p - p;
    sx += d.x();
    sy += d.y();
    sxx += d.x() * d.x();
    sxy += d.x() * d.y();
    syy += d.y() * d.y();
  }
  const double n = static_cast<double>(last - first + 1);
  const double xx = sxx - sx * sx / n;
  const double xy = sxy - sx * sy / n;
  const double yy = syy - sy * sy / n;
  // The eigenvector of the larger eigenvalue lies along the surface.
  const double half = 0.5 * (xx - yy);
  const double root = std::sqrt(half * half + xy * xy);
  const Vector2d along = half >= 0.0 ? Vector2d(half + root, xy) : Vector2d(xy, root - half);
  const double length = along.norm();
  return length > 0.0 ? Vector2d(-along.y() / length, along.x() / length) : Vector2d(0.0, 0.0);
}

}  // namespace cairn
