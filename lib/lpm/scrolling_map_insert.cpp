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
  const auto range_m = [&beams](std::size_t k) {
    return (beams.returns()[k].p - beams.origins()[k]).norm();
  };
  const double free_m = std::min({kApart_cells * cell_m / (beams.spacing_rad() * apart),
                                  range_m(i - apart) - cell_m, range_m(i + apart) - cell_m});
  const double own_m = range_m(i);
  return std::clamp(free_m / own_m, 0.0, 1.0);
}

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

void ScrollingMap::see_block(Cell c) {
  const int block = (c.y / kBlockCells) * blocks_across_ + c.x / kBlockCells;
  seen_travel_m_[static_cast<std::size_t>(block)] = travel_m_;
}

}  // namespace cairn
