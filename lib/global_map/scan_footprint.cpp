#include "global_map/scan_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "grid/ray_trace.hpp"

namespace cairn {
namespace {

/// How far a beam without return is free. One or a few such beams between two that hit something
/// are glass or a dark surface, not a hole: they are free no farther than their neighbours.
double free_range_m(const std::vector<float>& ranges_m, std::size_t beam, double reach_m) {
  constexpr std::size_t kNeighbours = 3;
  const auto nearest_return_m = [&](bool ahead) {
    for (std::size_t step = 1; step <= kNeighbours; ++step) {
      if (ahead ? beam + step >= ranges_m.size() : step > beam) {
        break;
      }
      const float range_m = ranges_m[ahead ? beam + step : beam - step];
      if (std::isfinite(range_m)) {
        return static_cast<double>(range_m);
      }
    }
    return std::numeric_limits<double>::infinity();
  };
  const double before_m = nearest_return_m(false);
  const double after_m = nearest_return_m(true);
  const bool is_between_returns = std::isfinite(before_m) && std::isfinite(after_m);
  return is_between_returns ? std::min({before_m, after_m, reach_m}) : reach_m;
}

}  // namespace

ScanFootprint::ScanFootprint(double cell_m, double draw_range_m) : draw_range_m_(draw_range_m) {
  const int reach_cells = static_cast<int>(std::ceil(draw_range_m / cell_m)) + 2;
  window_.cell_m = cell_m;
  window_.width = window_.height = 2 * reach_cells + 1;
  marks_.resize(window_.cell_count(), Mark::kNone);
  low_row_ = window_.height;
}

const std::vector<TouchedCell>& ScanFootprint::of(const LaserScan& scan,
                                                  const Pose2& T_global_laser) {
  const Vector2d laser = T_global_laser.translation();
  const Cell corner{static_cast<int>(std::floor(laser.x() / window_.cell_m)) - window_.width / 2,
                    static_cast<int>(std::floor(laser.y() / window_.cell_m)) - window_.height / 2};
  window_.origin_m = window_.cell_m * Vector2d(corner.x, corner.y);
  const double reach_m = std::min(draw_range_m_, scan.max_range_m);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      continue;
    }
    const double bearing_rad = T_global_laser.theta() + static_cast<double>(scan.bearings_rad[i]);
    const Vector2d direction(std::cos(bearing_rad), std::sin(bearing_rad));
    const double free_m =
        std::isinf(range_m) ? free_range_m(scan.ranges_m, i, reach_m) : std::min(range_m, reach_m);
    trace(laser, laser + free_m * direction, range_m <= reach_m);
  }
  for (const std::size_t hit : hits_) {
    marks_[hit] = Mark::kHit;  // Whatever passes there.
  }
  hits_.clear();
  collect(corner);
  return touched_;
}

/// Empties the window row by row, so that cells of one tile follow each other.
void ScanFootprint::collect(Cell corner) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  touched_.clear();
  const auto width = static_cast<std::size_t>(window_.width);
  for (int row = low_row_; row <= high_row_; ++row) {
    Mark* const marks = marks_.data() + static_cast<std::size_t>(row) * width;
    for (std::size_t column = 0; column < width; ++column) {
      std::uint64_t word = 1;
      if (column + kWord <= width) {
        std::memcpy(&word, marks + column, kWord);
      }
      if (word == 0) {
        column += kWord - 1;  // Most of the window is not touched.
        continue;
      }
      if (marks[column] != Mark::kNone) {
        touched_.push_back(
            {{corner.x + static_cast<int>(column), corner.y + row}, marks[column] == Mark::kHit});
        marks[column] = Mark::kNone;
      }
    }
  }
  low_row_ = window_.height;
  high_row_ = -1;
}

void ScanFootprint::trace(const Vector2d& from, const Vector2d& to, bool is_hit) {
  ray_.clear();
  trace_ray(window_, from, to, &ray_);
  if (ray_.empty()) {
    return;
  }
  for (const Cell& cell : ray_) {
    marks_[window_.index_of(cell)] = Mark::kPassed;
  }
  low_row_ = std::min({low_row_, ray_.front().y, ray_.back().y});
  high_row_ = std::max({high_row_, ray_.front().y, ray_.back().y});
  if (is_hit) {
    hits_.push_back(window_.index_of(ray_.back()));
  }
}

}  // namespace cairn
