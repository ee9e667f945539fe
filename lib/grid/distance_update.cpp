#include "grid/distance_update.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

#include "grid/cell_runs.hpp"
#include "grid/shift_rows.hpp"

namespace cairn {
namespace {

/// Rows to the nearest wall where that was never known.
constexpr std::int32_t kNeverKnown = std::numeric_limits<std::int32_t>::max();
/// Of cells that were never computed.
constexpr std::int32_t kNoDistance = -1;

CellState state_of(OccupancyGrid::LogOdds log_odds) {
  if (log_odds > OccupancyGrid::kOccupiedAbove) {
    return CellState::kOccupied;
  }
  return log_odds < OccupancyGrid::kFreeBelow ? CellState::kFree : CellState::kUnknown;
}

/// One row on the way up: how many rows below the nearest wall lies.
/// @param last the same for the row before; of this row in the end
void look_down(const std::uint8_t* is_free,
               std::size_t width,
               std::int32_t* last,
               std::int32_t* down) {
  for (std::size_t x = 0; x < width; ++x) {
    const std::int32_t rows = (last[x] + 1) & -std::int32_t{is_free[x]};
    last[x] = rows;
    down[x] = rows;
  }
}

/// One row on the way down: where the nearest wall lies, negative: below.
/// @param nearest how many rows below the nearest wall lies
void look_up(const std::uint8_t* is_free,
             std::size_t width,
             std::int32_t* last,
             std::int32_t* nearest) {
  for (std::size_t x = 0; x < width; ++x) {
    const std::int32_t up = (last[x] + 1) & -std::int32_t{is_free[x]};
    const std::int32_t down = nearest[x];
    const std::int32_t rows = up < down ? up : -down;
    last[x] = up;
    nearest[x] = std::abs(rows) >= DistanceUpdate::kNone ? DistanceUpdate::kNone : rows;
  }
}

}  // namespace

void DistanceUpdate::begin(const GridGeometry& geometry, const GridWindow& window) {
  is_first_ = true;
  const auto width = static_cast<std::size_t>(window.width);
  const auto height = static_cast<std::size_t>(window.height);
  const std::size_t count = width * height;
  result_.geometry_ = geometry;
  result_.window_ = window;
  result_.state_.resize(count);
  result_.squared_cells_.assign(count, kNoDistance);
  result_.to_basis_.assign(count, CellOffset{});
  height_ = height;
  is_free_.resize(count);
  to_nearest_.assign(count, kNeverKnown);
  to_nearest_was_.resize(count);
  above_.resize(width);
  envelope_.resize(width);
}

void DistanceUpdate::update(const StateGrid& grid, Cell moved) {
  const GridGeometry& geometry = grid.geometry();
  const GridWindow& window = result_.window_;
  if (window.width != geometry.width || window.height != geometry.height) {
    begin(geometry, whole_window(geometry));
    moved = {};
  } else {
    result_.geometry_ = geometry;
    shift(moved);
  }
  std::copy(grid.cells().begin(), grid.cells().end(), result_.state_.begin());
  update_rows(moved);
  if (is_first_) {
    changed_.resize(result_.state_.size());
    std::iota(changed_.begin(), changed_.end(), 0U);
  }
  is_first_ = false;
}

DistanceTransform DistanceUpdate::of_part(const OccupancyGrid& grid, const GridWindow& window) {
  DistanceUpdate update;
  update.begin(grid.geometry(), window);
  auto to = update.result_.state_.begin();
  for (int y = window.lower.y; y < window.lower.y + window.height; ++y) {
    const auto from = grid.cells().begin() + std::ptrdiff_t{y} * grid.geometry().width +
                      std::ptrdiff_t{window.lower.x};
    to = std::transform(from, from + window.width, to, state_of);
  }
  update.update_rows({});
  return std::move(update.result_);
}

void DistanceUpdate::shift(Cell moved) {
  if (moved == Cell{}) {
    return;
  }
  const auto [width, height] = std::pair(result_.window_.width, result_.window_.height);
  shift_rows(moved, width, height, kNoDistance, &result_.squared_cells_);
  shift_rows(moved, width, height, CellOffset{}, &result_.to_basis_);
  shift_rows(moved, width, height, kNeverKnown, &to_nearest_);
}

void DistanceUpdate::update_rows(Cell moved) {
  changed_.clear();
  std::swap(to_nearest_, to_nearest_was_);
  find_nearest_in_columns();
  for (std::size_t y = 0; y < height_; ++y) {
    update_row(y, moved);
  }
}

/// Row by row, as memory lies. Of two cells equally near the lower counts.
void DistanceUpdate::find_nearest_in_columns() {
  const std::size_t width = above_.size();
  const std::size_t height = height_;
  std::transform(result_.state_.begin(), result_.state_.end(), is_free_.begin(),
                 [](CellState state) -> std::uint8_t { return state == CellState::kFree ? 1 : 0; });
  std::fill(above_.begin(), above_.end(), kNone);
  for (std::size_t y = 0; y < height; ++y) {
    look_down(is_free_.data() + y * width, width, above_.data(), to_nearest_.data() + y * width);
  }
  std::fill(above_.begin(), above_.end(), kNone);
  for (std::size_t y = height; y-- > 0;) {
    look_up(is_free_.data() + y * width, width, above_.data(), to_nearest_.data() + y * width);
  }
}

void DistanceUpdate::update_row(std::size_t y, Cell moved) {
  const std::size_t width = above_.size();
  const std::size_t row = y * width;
  // A run that the border cuts may have gone on beyond it before.
  if (moved.x != 0 || !is_as_it_was(row, row + width)) {
    std::size_t behind = 0;
    for_each_run(is_free_.data() + row, 0, width, [&](std::size_t first, std::size_t last) {
      clear_cells(row, behind, first);
      behind = last;
      const bool is_cut = moved.x != 0 && (first == 0 || last == width);
      const std::size_t begin = first > 0 ? first - 1 : first;
      const std::size_t end = std::min(last + 1, width);
      if (is_cut || !is_as_it_was(row + begin, row + end)) {
        update_run({row, first, last, begin, end});
      }
    });
    clear_cells(row, behind, width);
  }
}

bool DistanceUpdate::is_as_it_was(std::size_t first, std::size_t last) const {
  return std::equal(to_nearest_.begin() + static_cast<std::ptrdiff_t>(first),
                    to_nearest_.begin() + static_cast<std::ptrdiff_t>(last),
                    to_nearest_was_.begin() + static_cast<std::ptrdiff_t>(first));
}

void DistanceUpdate::put(std::size_t row, std::size_t x, std::int32_t squared, CellOffset to) {
  const bool is_new =
      result_.squared_cells_[row + x] != squared || result_.to_basis_[row + x] != to;
  result_.squared_cells_[row + x] = squared;
  result_.to_basis_[row + x] = to;
  if (is_new && !is_first_) {
    changed_.push_back(static_cast<std::uint32_t>(row + x));
  }
}

/// Cells that are not free are their own basis points.
void DistanceUpdate::clear_cells(std::size_t row, std::size_t first, std::size_t last) {
  for (std::size_t x = first; x < last; ++x) {
    if (result_.squared_cells_[row + x] != 0) {
      put(row, x, 0, {});
    }
  }
}

}  // namespace cairn
