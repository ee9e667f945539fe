#include "lpm/scrolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Moves the content of a row-major window by whole cells, in place: the value at `c` goes to
/// `c - by`. What comes in is `fill`.
template <typename T>
void shift_cells(std::vector<T>* cells, int width, int height, Cell by, T fill) {
  if (std::abs(by.x) >= width || std::abs(by.y) >= height) {
    std::fill(cells->begin(), cells->end(), fill);
    return;
  }
  const std::ptrdiff_t ahead = static_cast<std::ptrdiff_t>(by.y) * width + by.x;
  const auto begin = cells->begin();
  const auto end = cells->end();
  if (ahead > 0) {
    std::fill(std::copy(begin + ahead, end, begin), end, fill);
  } else {
    std::fill(begin, std::copy_backward(begin, end + ahead, end), fill);
  }
  // Of every row, what came around from its neighbour.
  for (int y = 0; y < height; ++y) {
    const auto row = begin + static_cast<std::ptrdiff_t>(y) * width;
    std::fill(row + (by.x > 0 ? width - by.x : 0), row + (by.x > 0 ? width : -by.x), fill);
  }
}

/// Near the laser beams lie so close that every second frees what those between would, and still
/// nearer every fourth. How much of a beam need not be walked for that.
double share_freed_by_neighbours(const ScanBeams& beams, std::size_t i, double cell_m) {
  constexpr double kApart_cells = 0.35;  // of neighbours, so that no cell is missed between them
  const std::uint32_t number = beams.numbers()[i];
  const std::uint32_t apart = number % 2 == 1 ? 1U : (number % 4 == 2 ? 2U : 0U);
  const std::vector<std::uint32_t>& numbers = beams.numbers();
  if (apart == 0U || i < apart || i + apart >= numbers.size() ||
      numbers[i - apart] + apart != number || numbers[i + apart] - apart != number) {
    return 0.0;
  }
  const auto range_m = [&beams](std::size_t k) {
    return (beams.returns()[k].p - beams.origins()[k]).norm();
  };
  const double free_m = std::min({kApart_cells * cell_m / (beams.spacing_rad() * apart),
                                  range_m(i - apart) - cell_m, range_m(i + apart) - cell_m});
  const double own_m = range_m(i);
  return std::clamp(free_m / own_m, 0.0, 1.0);
}

int stored(double log_odds) {
  return static_cast<int>(std::lround(log_odds * OccupancyGrid::kLogOddsPerUnit));
}

}  // namespace

ScrollingMap::ScrollingMap(const ScrollingMapOptions& options)
    : options_(options),
      grid_(centred_window(options)),
      walls_(grid_.geometry()),
      surfaces_(grid_.geometry().width, grid_.geometry().height, SurfaceCell{}),
      marks_(grid_.geometry().cell_count(), 0),
      blocks_across_(grid_.geometry().width / kBlockCells) {
  const auto across = static_cast<std::size_t>(blocks_across_);
  seen_travel_m_.assign(across * across, -std::numeric_limits<double>::infinity());
}

void ScrollingMap::insert(const LaserScan& scan, const Pose2& T_lpm_robot, double travel_m) {
  ScanBeams beams;
  beams.take(scan, {}, options_.max_free_range_m);
  insert(beams, T_lpm_robot, travel_m);
}

void ScrollingMap::insert(const ScanBeams& beams, const Pose2& T_lpm_robot, double travel_m) {
  scroll_to(T_lpm_robot.translation());
  begin_scan(travel_m);
  mark_returns(beams, T_lpm_robot);
  const GridGeometry& geometry = grid_.geometry();
  const double c = std::cos(T_lpm_robot.theta()) / geometry.cell_m;
  const double s = std::sin(T_lpm_robot.theta()) / geometry.cell_m;
  const Vector2d origin = (T_lpm_robot.translation() - geometry.origin_m) / geometry.cell_m;
  const auto cells = [&](const Vector2d& p) {
    return Vector2d(origin.x() + c * p.x() - s * p.y(), origin.y() + s * p.x() + c * p.y());
  };
  for (std::size_t i = 0; i < beams.returns().size(); ++i) {
    const Vector2d& from = beams.origins()[i];
    const Vector2d& to = beams.returns()[i].p;
    const double share = share_freed_by_neighbours(beams, i, geometry.cell_m);
    free_beam<true>(cells(from + share * (to - from)), cells(to));
  }
  for (const ScanBeams::Beam& beam : beams.free_beams()) {
    free_beam<false>(cells(beam.from), cells(beam.to));
  }
  raise_returns();
  renew_walls();
}

std::size_t ScrollingMap::memory_bytes() const {
  return grid_.cells().capacity() * sizeof(OccupancyGrid::LogOdds) + walls_.memory_bytes() +
         surfaces_.memory_bytes() + marks_.capacity() + seen_travel_m_.capacity() * sizeof(double) +
         (returns_.capacity() + new_walls_.capacity()) * sizeof(Cell) +
         lost_walls_.capacity() * sizeof(std::size_t);
}

void ScrollingMap::clear() {
  std::fill(grid_.cells().begin(), grid_.cells().end(), OccupancyGrid::LogOdds{0});
  walls_.clear();
  surfaces_.clear();
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

void ScrollingMap::mark_returns(const ScanBeams& beams, const Pose2& T_lpm_robot) {
  const GridGeometry& geometry = grid_.geometry();
  const double c = std::cos(T_lpm_robot.theta());
  const double s = std::sin(T_lpm_robot.theta());
  for (const auto& [p, normal] : beams.returns()) {
    const Vector2d cells = (Vector2d(T_lpm_robot.x() + c * p.x() - s * p.y(),
                                     T_lpm_robot.y() + s * p.x() + c * p.y()) -
                            geometry.origin_m) /
                           geometry.cell_m;
    const Cell cell{static_cast<int>(std::floor(cells.x())),
                    static_cast<int>(std::floor(cells.y()))};
    if (!grid_.contains(cell)) {
      continue;
    }
    surfaces_[cell].take(cells - Vector2d(cell.x + 0.5, cell.y + 0.5),
                         {c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y()});
    std::uint8_t& mark = marks_[geometry.index_of(cell)];
    if (mark != scan_mark_) {
      mark = scan_mark_;
      see_block(cell);
      returns_.push_back(cell);
    }
  }
}

/// Steps from column to column, or from row to row where the beam is steep, in fixed point.
template <bool has_return>
void ScrollingMap::free_beam(const Vector2d& from, const Vector2d& to) {
  const GridGeometry& geometry = grid_.geometry();
  const Vector2d way = to - from;
  const bool is_steep = std::abs(way.y()) > std::abs(way.x());
  const int major = is_steep ? 1 : 0;
  const int minor = 1 - major;
  if (way[major] == 0.0) {
    return;
  }
  const int major_size = is_steep ? geometry.height : geometry.width;
  const int minor_size = is_steep ? geometry.width : geometry.height;
  const double slope = way[minor] / way[major];
  const int direction = way[major] > 0.0 ? 1 : -1;
  const double last_major = std::clamp(to[major], -1.0, major_size + 0.0);
  int at = static_cast<int>(std::floor(std::clamp(from[major], 0.0, major_size - 1.0)));
  const int end = static_cast<int>(std::floor(last_major)) + direction;
  constexpr double kOne = 65'536.0 * 65'536.0;
  auto across = static_cast<std::int64_t>(kOne * (from[minor] + slope * (at + 0.5 - from[major])));
  const auto across_step = static_cast<std::int64_t>(kOne * slope * direction);
  const std::size_t major_stride = is_steep ? static_cast<std::size_t>(geometry.width) : 1U;
  const std::size_t minor_stride = is_steep ? 1U : static_cast<std::size_t>(geometry.width);
  const int miss = stored(options_.miss_log_odds);
  const int limit = stored(options_.max_log_odds);
  for (; at != end && at >= 0 && at < major_size; at += direction, across += across_step) {
    const auto other = static_cast<int>(across >> 32U);
    if (other < 0 || other >= minor_size) {
      return;
    }
    const std::size_t index = static_cast<std::size_t>(at) * major_stride +
                              static_cast<std::size_t>(other) * minor_stride;
    if (!has_return && grid_.cells()[index] > OccupancyGrid::kOccupiedAbove) {
      return;
    }
    if (marks_[index] != scan_mark_) {
      marks_[index] = scan_mark_;
      OccupancyGrid::LogOdds& value = grid_.cells()[index];
      const int next = std::max(value - miss, -limit);
      if (value > OccupancyGrid::kOccupiedAbove && next <= OccupancyGrid::kOccupiedAbove) {
        lost_walls_.push_back(index);
      }
      value = static_cast<OccupancyGrid::LogOdds>(next);
    }
    if (at % (kBlockCells / 2) == 0) {
      see_block(is_steep ? Cell{other, at} : Cell{at, other});
    }
  }
}

void ScrollingMap::raise_returns() {
  const int hit = stored(options_.hit_log_odds);
  const int limit = stored(options_.max_log_odds);
  for (const Cell c : returns_) {
    OccupancyGrid::LogOdds& value = grid_.log_odds(c);
    const int next = std::min(value + hit, limit);
    if (value <= OccupancyGrid::kOccupiedAbove && next > OccupancyGrid::kOccupiedAbove) {
      new_walls_.push_back(c);
    }
    value = static_cast<OccupancyGrid::LogOdds>(next);
  }
}

void ScrollingMap::renew_walls() {
  constexpr int kMostCells = 16;  // walls lost near each other are renewed together
  const auto width = static_cast<std::size_t>(grid_.geometry().width);
  Cell low;
  Cell high{-1, -1};
  for (const std::size_t index : lost_walls_) {
    const Cell c{static_cast<int>(index % width), static_cast<int>(index / width)};
    surfaces_[c] = {};
    const Cell grown_low{std::min(low.x, c.x), std::min(low.y, c.y)};
    const Cell grown_high{std::max(high.x, c.x), std::max(high.y, c.y)};
    const bool is_first = high.x < 0;
    if (!is_first && grown_high.x - grown_low.x < kMostCells &&
        grown_high.y - grown_low.y < kMostCells) {
      low = grown_low;
      high = grown_high;
      continue;
    }
    if (!is_first) {
      walls_.renew(grid_, low, high);
    }
    low = c;
    high = c;
  }
  if (high.x >= 0) {
    walls_.renew(grid_, low, high);
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
  if (by != Cell{}) {
    move_cells(by);
  }
}

void ScrollingMap::move_cells(Cell by) {
  const GridGeometry& geometry = grid_.geometry();
  shift_cells(&grid_.cells(), geometry.width, geometry.height, by, OccupancyGrid::LogOdds{0});
  shift_cells(&seen_travel_m_, blocks_across_, blocks_across_,
              {by.x / kBlockCells, by.y / kBlockCells}, -std::numeric_limits<double>::infinity());
  grid_.move_origin(geometry.origin_m + geometry.cell_m * Vector2d(by.x, by.y));
  walls_.shift(by);
  surfaces_.shift(by);
  // The marks may lie where they are: they are those of earlier scans.
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
      surfaces_[{x, y}] = {};
    }
  }
  if (had_walls) {
    walls_.renew(grid_, low, high);
  }
}

void ScrollingMap::see_block(Cell c) {
  const int block = (c.y / kBlockCells) * blocks_across_ + c.x / kBlockCells;
  seen_travel_m_[static_cast<std::size_t>(block)] = travel_m_;
}

}  // namespace cairn
