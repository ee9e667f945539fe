// How a scan gets into the map; the window itself is the business of scrolling_map.cpp.

#include <algorithm>
#include <cmath>

#include "lpm/scrolling_map.hpp"

namespace cairn {
namespace {

constexpr int kBlockCells = ScrollingMap::kBlockCells;

int stored(double log_odds) {
  return static_cast<int>(std::lround(log_odds * OccupancyGrid::kLogOddsPerUnit));
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
  const auto range_m = [&beams](std::size_t k) { return static_cast<double>(beams.ranges_m()[k]); };
  const double free_m = std::min({kApart_cells * cell_m / (beams.spacing_rad() * apart),
                                  range_m(i - apart) - cell_m, range_m(i + apart) - cell_m});
  const double own_m = range_m(i);
  return std::clamp(free_m / own_m, 0.0, 1.0);
}

/// The way of a beam from cell to cell, one per column, or row where it is steep; as far as it lies
/// within the window.
struct BeamWalk {
  static constexpr double kOne = 65'536.0 * 65'536.0;

  /// @param from, to in cells
  BeamWalk(const GridGeometry& geometry, const Vector2d& from, const Vector2d& to) {
    const Vector2d way = to - from;
    is_steep = std::abs(way.y()) > std::abs(way.x());
    const int major = is_steep ? 1 : 0;
    const int minor = 1 - major;
    if (way[major] == 0.0) {
      return;
    }
    const int major_size = is_steep ? geometry.height : geometry.width;
    const int minor_size = is_steep ? geometry.width : geometry.height;
    const double slope = way[minor] / way[major];
    direction = way[major] > 0.0 ? 1 : -1;
    at = static_cast<int>(std::floor(std::clamp(from[major], 0.0, major_size - 1.0)));
    const int last = static_cast<int>(std::floor(std::clamp(to[major], -1.0, 1.0 * major_size)));
    const int within = direction > 0 ? major_size - at : at + 1;
    steps = std::clamp(direction * (last - at) + 1, 0, within);
    across = static_cast<std::int64_t>(kOne * (from[minor] + slope * (at + 0.5 - from[major])));
    across_step = static_cast<std::int64_t>(kOne * slope * direction);
    stay_within(minor_size);
    along_stride = direction * (is_steep ? geometry.width : 1);
    across_stride = is_steep ? 1 : geometry.width;
    first = std::ptrdiff_t{at} * (is_steep ? geometry.width : 1);
    constexpr int kHalf = ScrollingMap::kBlockCells / 2;
    first_seen = direction > 0 ? (kHalf - at % kHalf) % kHalf : at % kHalf;
  }

  [[nodiscard]] Cell cell_at(int step) const {
    const int along = at + direction * step;
    const auto other = static_cast<int>((across + step * across_step) >> 32U);
    return is_steep ? Cell{other, along} : Cell{along, other};
  }

  int steps = 0;
  std::int64_t across = 0;  // of the first step, in 2^-32 cells
  std::int64_t across_step = 0;
  std::ptrdiff_t first = 0;  // index of the first step, but for what lies across
  std::ptrdiff_t along_stride = 0;
  std::ptrdiff_t across_stride = 0;
  int first_seen = 0;  // step at which a block is entered, or left halfway

 private:
  /// No step after the first one that leaves the window.
  void stay_within(int minor_size) {
    const auto end = static_cast<std::int64_t>(minor_size) << 32U;
    if (across < 0 || across >= end) {
      steps = 0;
    } else if (across_step > 0) {
      steps = static_cast<int>(std::min<std::int64_t>(steps, 1 + (end - 1 - across) / across_step));
    } else if (across_step < 0) {
      steps = static_cast<int>(std::min<std::int64_t>(steps, 1 + across / -across_step));
    }
  }

  bool is_steep = false;
  int direction = 1;
  int at = 0;
};

}  // namespace

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
  const BeamWalk walk(grid_.geometry(), from, to);
  // The marks are bytes, which may be anything to a compiler: so nothing is looked up through this.
  std::uint8_t* const marks = marks_.data();
  OccupancyGrid::LogOdds* const cells = grid_.cells().data();
  const std::uint8_t scan_mark = scan_mark_;
  const int miss = stored(options_.miss_log_odds);
  const int limit = stored(options_.max_log_odds);
  std::int64_t across = walk.across;
  std::ptrdiff_t along = walk.first;
  int step = 0;
  for (; step < walk.steps; ++step, across += walk.across_step, along += walk.along_stride) {
    const std::ptrdiff_t index = along + (across >> 32U) * walk.across_stride;
    if (!has_return && cells[index] > OccupancyGrid::kOccupiedAbove) {
      break;
    }
    // Whether a cell was passed before in this scan is anybody's guess: no branch on that.
    const int value = cells[index];
    const int next = std::max(value - (marks[index] != scan_mark ? miss : 0), -limit);
    marks[index] = scan_mark;
    cells[index] = static_cast<OccupancyGrid::LogOdds>(next);
    if (value > OccupancyGrid::kOccupiedAbove && next <= OccupancyGrid::kOccupiedAbove) {
      lost_walls_.push_back(static_cast<std::size_t>(index));
    }
  }
  for (int i = walk.first_seen; i < step; i += kBlockCells / 2) {
    see_block(walk.cell_at(i));
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

void ScrollingMap::see_block(Cell c) {
  const int block = (c.y / kBlockCells) * blocks_across_ + c.x / kBlockCells;
  seen_travel_m_[static_cast<std::size_t>(block)] = travel_m_;
}

}  // namespace cairn
