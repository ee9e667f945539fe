#include "grid/axis_update.hpp"

#include <algorithm>
#include <cmath>

#include "grid/axis_graph.hpp"

namespace cairn {
namespace {

/// Whether the angle between the basis points of two neighbours, each seen from its own cell, is
/// larger than that of the cosine.
bool look_apart(CellOffset a, CellOffset b, double max_cosine) {
  const Vector2d from_a(a.dx, a.dy);
  const Vector2d from_b(b.dx, b.dy);
  const double dot = from_a.dot(from_b);
  // Most neighbours look to the same wall: no roots needed.
  const bool is_same_wall = dot >= 0.0 && max_cosine <= 0.0;
  return !is_same_wall && dot < max_cosine * from_a.norm() * from_b.norm();
}

}  // namespace

MedialAxis AxisUpdate::axis(const DistanceTransform& distances,
                            Cell start,
                            const MedialAxisOptions& options) {
  component_.find(distances, start, options.min_clearance_m);
  if (component_.runs().empty()) {
    return {};
  }
  set_.clear(distances.window().width, distances.window().height);
  ridge_.clear(distances.window().width, distances.window().height);
  fill_set();
  mark_ridge(distances, options.min_basis_angle_rad);
  sort_by_clearance(distances);
  thin(ridge_, &order_, &set_);
  return pruned(traced_axis(set_, order_, distances), options.coastal_distance_m, distances);
}

void AxisUpdate::fill_set() {
  for (const CellRun& run : component_.runs()) {
    std::uint8_t* const row = set_.data() + set_.index_of(0, static_cast<std::size_t>(run.y));
    std::fill(row + run.first, row + run.last, std::uint8_t{1});
  }
}

/// Where two neighbours look to different walls, the one with the larger clearance.
void AxisUpdate::mark_ridge(const DistanceTransform& distances, double min_angle_rad) {
  const double max_cosine = std::cos(min_angle_rad);
  const auto width = static_cast<std::size_t>(distances.window().width);
  const std::int32_t* const squared = distances.squared_clearances_cells().data();
  const CellOffset* const to_basis = distances.basis_offsets().data();
  for (const CellRun& run : component_.runs()) {
    const auto y = static_cast<std::size_t>(run.y);
    for (auto x = static_cast<std::size_t>(run.first); x < static_cast<std::size_t>(run.last);
         ++x) {
      const std::size_t at = y * width + x;
      const std::size_t padded = set_.index_of(x, y);
      if (set_.has(padded + 1) && look_apart(to_basis[at], to_basis[at + 1], max_cosine)) {
        ridge_.add(squared[at] >= squared[at + 1] ? padded : padded + 1);
      }
      const std::size_t above = padded + set_.stride();
      if (set_.has(above) && look_apart(to_basis[at], to_basis[at + width], max_cosine)) {
        ridge_.add(squared[at] >= squared[at + width] ? padded : above);
      }
    }
  }
}

/// A counting sort; of equals the lowest index comes first. What nothing bounds comes last, in a
/// bucket of its own.
void AxisUpdate::sort_by_clearance(const DistanceTransform& distances) {
  const auto width = static_cast<std::size_t>(distances.window().width);
  const std::int32_t* const squared = distances.squared_clearances_cells().data();
  const auto for_each_cell = [&](auto visit) {
    for (const CellRun& run : component_.runs()) {
      const auto y = static_cast<std::size_t>(run.y);
      for (auto x = static_cast<std::size_t>(run.first); x < static_cast<std::size_t>(run.last);
           ++x) {
        visit(x, y, squared[y * width + x]);
      }
    }
  };
  std::int32_t most = 0;
  for_each_cell([&](std::size_t, std::size_t, std::int32_t value) {
    most = value == DistanceTransform::kUnbounded ? most : std::max(most, value);
  });
  const auto bucket_of = [most](std::int32_t value) {
    return static_cast<std::size_t>(std::min(value, most + 1));
  };
  bucket_.assign(static_cast<std::size_t>(most) + 3, 0);
  for_each_cell(
      [&](std::size_t, std::size_t, std::int32_t value) { ++bucket_[bucket_of(value) + 1]; });
  for (std::size_t i = 1; i < bucket_.size(); ++i) {
    bucket_[i] += bucket_[i - 1];
  }
  order_.resize(bucket_.back());
  for_each_cell([&](std::size_t x, std::size_t y, std::int32_t value) {
    order_[bucket_[bucket_of(value)]++] = static_cast<std::uint32_t>(set_.index_of(x, y));
  });
}

}  // namespace cairn
