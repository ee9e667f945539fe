#include "lpm/scrolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/ray_trace.hpp"

namespace cairn {
namespace {

constexpr int kBlockCells = 16;
constexpr int kScrollBlocks = 2;        // the robot may leave the middle by so much
constexpr double kForgetEvery_m = 1.0;  // travel between two looks for what to forget
constexpr std::uint8_t kLastMark = 255;

GridGeometry centred_window(const ScrollingMapOptions& options) {
  const int blocks =
      std::max(4, static_cast<int>(std::lround(options.window_m / options.cell_m / kBlockCells)));
  GridGeometry geometry;
  geometry.cell_m = options.cell_m;
  geometry.width = blocks * kBlockCells;
  geometry.height = geometry.width;
  geometry.origin_m.setConstant(-0.5 * geometry.width * geometry.cell_m);
  return geometry;
}

int stored(double log_odds) {
  return static_cast<int>(std::lround(log_odds * OccupancyGrid::kLogOddsPerUnit));
}

}  // namespace

ScrollingMap::ScrollingMap(const ScrollingMapOptions& options)
    : options_(options),
      grid_(centred_window(options)),
      walls_(grid_.geometry()),
      marks_(grid_.geometry().cell_count(), 0),
      blocks_across_(grid_.geometry().width / kBlockCells) {
  const auto across = static_cast<std::size_t>(blocks_across_);
  seen_travel_m_.assign(across * across, -std::numeric_limits<double>::infinity());
}

void ScrollingMap::insert(const LaserScan& scan, const Pose2& T_lpm_robot, double travel_m) {
  scroll_to(T_lpm_robot.translation());
  begin_scan(travel_m);
  const Pose2 T_lpm_laser = T_lpm_robot * scan.T_robot_laser;
  mark_returns(scan, T_lpm_laser);
  const Vector2d from = T_lpm_laser.translation();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      continue;
    }
    const bool has_return = std::isfinite(range_m) && range_m <= scan.max_range_m;
    const double free_m =
        has_return ? range_m : std::min(scan.max_range_m, options_.max_free_range_m);
    const double bearing_rad = static_cast<double>(scan.bearings_rad[i]);
    const Vector2d direction(std::cos(bearing_rad), std::sin(bearing_rad));
    free_beam(from, T_lpm_laser * Vector2d(free_m * direction), has_return);
  }
  for (const Cell c : returns_) {
    add_log_odds(c, stored(options_.hit_log_odds));
  }
  renew_walls();
}

std::size_t ScrollingMap::memory_bytes() const {
  return grid_.cells().size() * (sizeof(OccupancyGrid::LogOdds) + 2 * sizeof(std::uint8_t)) +
         seen_travel_m_.size() * sizeof(double);
}

void ScrollingMap::clear() {
  std::fill(grid_.cells().begin(), grid_.cells().end(), OccupancyGrid::LogOdds{0});
  walls_.clear();
}

void ScrollingMap::begin_scan(double travel_m) {
  travel_m_ = travel_m;
  if (travel_m_ - forgotten_at_travel_m_ > kForgetEvery_m) {
    forget(travel_m_);
  }
  if (scan_mark_ == kLastMark) {
    std::fill(marks_.begin(), marks_.end(), std::uint8_t{0});
    scan_mark_ = 0;
  }
  ++scan_mark_;
  returns_.clear();
}

void ScrollingMap::mark_returns(const LaserScan& scan, const Pose2& T_lpm_laser) {
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (!std::isfinite(range_m) || range_m > scan.max_range_m) {
      continue;
    }
    const double bearing_rad = static_cast<double>(scan.bearings_rad[i]);
    const Cell c = grid_.geometry().cell_at(
        T_lpm_laser * Vector2d(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)));
    if (grid_.contains(c) && is_unmarked(c)) {
      mark(c);
      returns_.push_back(c);
    }
  }
}

void ScrollingMap::free_beam(const Vector2d& from, const Vector2d& to, bool has_return) {
  ray_.clear();
  trace_ray(grid_.geometry(), from, to, &ray_);
  for (const Cell c : ray_) {
    if (!has_return && grid_.state(c) == CellState::kOccupied) {
      return;
    }
    if (is_unmarked(c)) {
      mark(c);
      add_log_odds(c, -stored(options_.miss_log_odds));
    }
  }
}

void ScrollingMap::add_log_odds(Cell c, int change) {
  const int limit = stored(options_.max_log_odds);
  OccupancyGrid::LogOdds& value = grid_.log_odds(c);
  const bool was_wall = value > OccupancyGrid::kOccupiedAbove;
  value = static_cast<OccupancyGrid::LogOdds>(std::clamp(value + change, -limit, limit));
  const bool is_wall = value > OccupancyGrid::kOccupiedAbove;
  if (is_wall != was_wall) {
    (is_wall ? new_walls_ : lost_walls_).push_back(c);
  }
}

void ScrollingMap::renew_walls() {
  for (const Cell c : lost_walls_) {
    walls_.renew(grid_, c, c);
  }
  for (const Cell c : new_walls_) {
    walls_.add_wall(c);
  }
  lost_walls_.clear();
  new_walls_.clear();
}

void ScrollingMap::scroll_to(const Vector2d& p_lpm) {
  const GridGeometry& geometry = grid_.geometry();
  const Cell robot = geometry.cell_at(p_lpm);
  const auto whole_blocks = [](int off_centre) {
    const int blocks = off_centre / kBlockCells;
    return std::abs(blocks) >= kScrollBlocks ? blocks * kBlockCells : 0;
  };
  const Cell by{whole_blocks(robot.x - geometry.width / 2),
                whole_blocks(robot.y - geometry.height / 2)};
  if (by == Cell{}) {
    return;
  }
  GridGeometry moved = geometry;
  moved.origin_m += moved.cell_m * Vector2d(by.x, by.y);
  OccupancyGrid grid(moved);
  grid.cells() = grid_.cells();
  shift_cells(&grid.cells(), moved.width, moved.height, by, OccupancyGrid::LogOdds{0});
  grid_ = std::move(grid);
  walls_.shift(by);
  shift_cells(&seen_travel_m_, blocks_across_, blocks_across_,
              {by.x / kBlockCells, by.y / kBlockCells}, -std::numeric_limits<double>::infinity());
  std::fill(marks_.begin(), marks_.end(), std::uint8_t{0});
  scan_mark_ = 0;
}

void ScrollingMap::forget(double travel_m) {
  forgotten_at_travel_m_ = travel_m;
  for (int y = 0; y < blocks_across_; ++y) {
    for (int x = 0; x < blocks_across_; ++x) {
      double& seen_m = seen_travel_m_[static_cast<std::size_t>(y * blocks_across_ + x)];
      if (std::isfinite(seen_m) && travel_m - seen_m > options_.memory_travel_m) {
        seen_m = -std::numeric_limits<double>::infinity();
        forget_block(x, y);
      }
    }
  }
}

void ScrollingMap::forget_block(int block_x, int block_y) {
  const Cell low{block_x * kBlockCells, block_y * kBlockCells};
  const Cell high{low.x + kBlockCells - 1, low.y + kBlockCells - 1};
  bool had_walls = false;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      OccupancyGrid::LogOdds& value = grid_.log_odds({x, y});
      had_walls = had_walls || value > OccupancyGrid::kOccupiedAbove;
      value = 0;
    }
  }
  if (had_walls) {
    walls_.renew(grid_, low, high);
  }
}

bool ScrollingMap::is_unmarked(Cell c) const {
  return marks_[grid_.geometry().index_of(c)] != scan_mark_;
}

void ScrollingMap::mark(Cell c) {
  marks_[grid_.geometry().index_of(c)] = scan_mark_;
  const int block = (c.y / kBlockCells) * blocks_across_ + c.x / kBlockCells;
  seen_travel_m_[static_cast<std::size_t>(block)] = travel_m_;
}

}  // namespace cairn
