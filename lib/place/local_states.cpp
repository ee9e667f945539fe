#include "place/local_states.hpp"

#include <algorithm>
#include <cmath>

#include "grid/cell_runs.hpp"

namespace cairn {
namespace {

/// Chinks in a wall lie within so many cells of it.
constexpr std::size_t kChink = 2;

int cells_moved(double by_m, double cell_m, int most) {
  return static_cast<int>(std::lround(std::clamp<double>(by_m / cell_m, -most, most)));
}

CellState merged(OccupancyGrid::LogOdds highest, OccupancyGrid::LogOdds lowest) {
  if (highest > OccupancyGrid::kOccupiedAbove) {
    return CellState::kOccupied;
  }
  return lowest < OccupancyGrid::kFreeBelow ? CellState::kFree : CellState::kUnknown;
}

}  // namespace

void LocalStates::take(const OccupancyGrid& map,
                       const Vector2d& p_map_robot,
                       const PlaceOptions& options) {
  const double fine_m = map.geometry().cell_m;
  factor_ = std::max(1, static_cast<int>(std::floor(options.cell_m / fine_m + 1e-6)));
  place_window(map, p_map_robot, options.window_m);
  coarsen(map);
  fill_stripes();
  clear_specks(options.speck_m);
  mark_walls();
}

void LocalStates::place_window(const OccupancyGrid& map,
                               const Vector2d& p_map_robot,
                               double side_m) {
  GridGeometry coarse;
  coarse.cell_m = factor_ * map.geometry().cell_m;
  coarse.width = static_cast<int>(std::ceil(side_m / coarse.cell_m));
  coarse.height = coarse.width;
  const auto aligned = [&](double middle) {
    return coarse.cell_m * (std::floor(middle / coarse.cell_m) - coarse.width / 2);
  };
  coarse.origin_m = {aligned(p_map_robot.x()), aligned(p_map_robot.y())};
  const Vector2d by_m = coarse.origin_m - grid_.geometry().origin_m;
  moved_ = {cells_moved(by_m.x(), coarse.cell_m, coarse.width),
            cells_moved(by_m.y(), coarse.cell_m, coarse.height)};
  grid_.reshape(coarse);
}

void LocalStates::coarsen(const OccupancyGrid& map) {
  const GridGeometry& fine = map.geometry();
  const GridGeometry& coarse = grid_.geometry();
  const Vector2d offset = (coarse.origin_m - fine.origin_m) / fine.cell_m;
  const Cell first{static_cast<int>(std::lround(offset.x())),
                   static_cast<int>(std::lround(offset.y()))};
  const auto width = static_cast<std::size_t>(coarse.width);
  const auto factor = static_cast<std::size_t>(factor_);
  for (int y = 0; y < coarse.height; ++y) {
    merge_row(map, {first.x, first.y + y * factor_});
    CellState* const row = grid_.cells().data() + static_cast<std::size_t>(y) * width;
    const OccupancyGrid::LogOdds* const highest = highest_.data();
    const OccupancyGrid::LogOdds* const lowest = lowest_.data();
    if (factor == 2) {  // As it is by default; a loop with a known stride is several times faster.
      for (std::size_t x = 0; x < width; ++x) {
        row[x] = merged(std::max(highest[2 * x], highest[2 * x + 1]),
                        std::min(lowest[2 * x], lowest[2 * x + 1]));
      }
      continue;
    }
    for (std::size_t x = 0; x < width; ++x) {
      row[x] = merged(*std::max_element(highest + x * factor, highest + (x + 1) * factor),
                      *std::min_element(lowest + x * factor, lowest + (x + 1) * factor));
    }
  }
}

/// Of the rows of the map that make one of the window, the highest and lowest log odds by column.
void LocalStates::merge_row(const OccupancyGrid& map, Cell first) {
  const GridGeometry& fine = map.geometry();
  const int count = grid_.geometry().width * factor_;
  highest_.assign(static_cast<std::size_t>(count), 0);
  lowest_.assign(static_cast<std::size_t>(count), 0);
  const int begin = std::clamp(-first.x, 0, count);
  const int end = std::clamp(fine.width - first.x, begin, count);
  for (int y = std::max(first.y, 0); y < std::min(first.y + factor_, fine.height); ++y) {
    const OccupancyGrid::LogOdds* const row = map.cells().data() + std::ptrdiff_t{y} * fine.width;
    OccupancyGrid::LogOdds* const highest = highest_.data();
    OccupancyGrid::LogOdds* const lowest = lowest_.data();
    for (int i = begin; i < end; ++i) {
      highest[i] = std::max(highest[i], row[first.x + i]);
      lowest[i] = std::min(lowest[i], row[first.x + i]);
    }
  }
}

/// Unknown cells between free ones on opposite sides become free.
void LocalStates::fill_stripes() {
  const auto width = static_cast<std::size_t>(grid_.geometry().width);
  const auto height = static_cast<std::size_t>(grid_.geometry().height);
  const std::size_t stride = width + 2;
  padded_.assign(stride * (height + 2), 0);
  for (std::size_t y = 0; y < height; ++y) {
    const CellState* const row = grid_.cells().data() + y * width;
    std::uint8_t* const is_free = padded_.data() + (y + 1) * stride + 1;
    for (std::size_t x = 0; x < width; ++x) {
      is_free[x] = row[x] == CellState::kFree ? 1 : 0;
    }
  }
  for (std::size_t y = 0; y < height; ++y) {
    CellState* const row = grid_.cells().data() + y * width;
    const std::uint8_t* const own = padded_.data() + (y + 1) * stride + 1;
    const std::uint8_t* const left = own - 1;
    const std::uint8_t* const below = left - stride;
    const std::uint8_t* const above = left + stride;
    for (std::size_t x = 0; x < width; ++x) {
      const auto is_between =
          static_cast<std::uint8_t>((left[x] & left[x + 2]) | (below[x + 1] & above[x + 1]) |
                                    (below[x] & above[x + 2]) | (above[x] & below[x + 2]));
      const CellState filled = is_between != 0 ? CellState::kFree : CellState::kUnknown;
      row[x] = row[x] == CellState::kUnknown ? filled : row[x];
    }
  }
}

/// Frees what is not free but lies all alone, and is small.
void LocalStates::clear_specks(double speck_m) {
  const GridGeometry& geometry = grid_.geometry();
  const int max_cells = static_cast<int>(std::floor(speck_m / geometry.cell_m + 1e-6));
  const auto width = static_cast<std::size_t>(geometry.width);
  pieces_.clear();
  rows_.resize(width);
  std::size_t below = 0;
  for (int y = 0; y < geometry.height; ++y) {
    const CellState* const row = grid_.cells().data() + static_cast<std::size_t>(y) * width;
    std::transform(row, row + width, rows_.begin(), [](CellState state) -> std::uint8_t {
      return state != CellState::kFree ? 1 : 0;
    });
    for_each_run(rows_.data(), 0, width, [&](std::size_t first, std::size_t last) {
      add_piece(y, static_cast<int>(first), static_cast<int>(last) - 1, &below);
    });
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& whole = pieces_[root_of(i)];
    const bool is_inside = whole.low.x > 0 && whole.low.y > 0 &&
                           whole.high.x < geometry.width - 1 && whole.high.y < geometry.height - 1;
    if (is_inside && whole.high.x - whole.low.x < max_cells &&
        whole.high.y - whole.low.y < max_cells) {
      CellState* const row = grid_.cells().data() + geometry.index_of({0, pieces_[i].y});
      std::fill(row + pieces_[i].first, row + pieces_[i].last + 1, CellState::kFree);
    }
  }
}

/// @param below the first one of the row below that may touch this one, or the next in this row
void LocalStates::add_piece(int y, int first, int last, std::size_t* below) {
  const std::size_t number = pieces_.size();
  pieces_.push_back({y, first, last, number, {first, y}, {last, y}});
  while (*below < number && (pieces_[*below].y < y - 1 ||
                             (pieces_[*below].y == y - 1 && pieces_[*below].last < first - 1))) {
    ++*below;
  }
  for (std::size_t i = *below; pieces_[i].y == y - 1 && pieces_[i].first <= last + 1; ++i) {
    join(i, number);
  }
}

std::size_t LocalStates::root_of(std::size_t piece) {
  while (pieces_[piece].parent != piece) {
    pieces_[piece].parent = pieces_[pieces_[piece].parent].parent;
    piece = pieces_[piece].parent;
  }
  return piece;
}

void LocalStates::join(std::size_t a, std::size_t b) {
  a = root_of(a);
  b = root_of(b);
  if (a == b) {
    return;
  }
  Piece& root = pieces_[std::min(a, b)];
  Piece& other = pieces_[std::max(a, b)];
  other.parent = std::min(a, b);
  root.low = {std::min(root.low.x, other.low.x), std::min(root.low.y, other.low.y)};
  root.high = {std::max(root.high.x, other.high.x), std::max(root.high.y, other.high.y)};
}

/// Marks what is not free, at walls or within two cells of one: first along the rows, then across.
void LocalStates::mark_walls() {
  const auto width = static_cast<std::size_t>(grid_.geometry().width);
  const auto height = static_cast<std::size_t>(grid_.geometry().height);
  rows_.assign(width * (height + 2 * kChink), 0);
  padded_.assign(width + 2 * kChink, 0);
  for (std::size_t y = 0; y < height; ++y) {
    const CellState* const row = grid_.cells().data() + y * width;
    std::uint8_t* const near = rows_.data() + (y + kChink) * width;
    const std::uint8_t* const from = padded_.data();
    std::transform(row, row + width, padded_.begin() + kChink, [](CellState state) -> std::uint8_t {
      return state == CellState::kOccupied ? 1 : 0;
    });
    for (std::size_t x = 0; x < width; ++x) {
      near[x] = static_cast<std::uint8_t>(from[x] | from[x + 1] | from[x + 2] | from[x + 3] |
                                          from[x + 4]);
    }
  }
  const std::size_t count = width * height;
  is_wall_.resize(count);
  const CellState* const state = grid_.cells().data();
  const std::uint8_t* const near = rows_.data();
  std::uint8_t* const is_wall = is_wall_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const int is_near =
        near[i] | near[i + width] | near[i + 2 * width] | near[i + 3 * width] | near[i + 4 * width];
    is_wall[i] = static_cast<std::uint8_t>(is_near & (state[i] != CellState::kFree ? 1 : 0));
  }
}

}  // namespace cairn
