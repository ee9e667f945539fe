#include "lpm/scrolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr int kBlockCells = ScrollingMap::kBlockCells;
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

}  // namespace cairn
