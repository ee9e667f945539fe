#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "grid/cell_runs.hpp"
#include "grid/distance_transform.hpp"

namespace cairn {
namespace {

/// Rows to where there is no wall. Grows by less than as much again over the rows of a grid.
constexpr std::int32_t kNone = 1 << 29;
/// Rows to the nearest wall where that was never known.
constexpr std::int32_t kNeverKnown = std::numeric_limits<std::int32_t>::max();
/// Of cells that were never computed.
constexpr std::int32_t kNoDistance = -1;

/// Moves the rows of a window along with the ground; `fill` is what nothing is known of.
template <typename Value>
void shift_rows(Cell moved, int width, int height, Value fill, std::vector<Value>* cells) {
  const auto row_at = [&](int y) { return cells->data() + std::ptrdiff_t{y} * width; };
  const int kept = std::max(0, width - std::abs(moved.x));
  const int to_x = kept > 0 ? std::max(0, -moved.x) : width;
  const int from_x = std::max(0, moved.x);
  const auto take = [&](int y) {
    const int from_y = y + moved.y;
    Value* const to = row_at(y);
    if (from_y < 0 || from_y >= height || kept == 0) {
      std::fill_n(to, width, fill);
      return;
    }
    std::memmove(static_cast<void*>(to + to_x), row_at(from_y) + from_x,
                 static_cast<std::size_t>(kept) * sizeof(Value));
    std::fill_n(to, to_x, fill);
    std::fill_n(to + to_x + kept, width - kept - to_x, fill);
  };
  for (int i = 0; i < height; ++i) {
    take(moved.y >= 0 ? i : height - 1 - i);
  }
}

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
    const std::int32_t rows = (last[x] + 1) * std::int32_t{is_free[x]};
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
    const std::int32_t up = (last[x] + 1) * std::int32_t{is_free[x]};
    const std::int32_t down = nearest[x];
    const std::int32_t rows = up < down ? up : -down;
    last[x] = up;
    nearest[x] = std::abs(rows) >= kNone ? kNone : rows;
  }
}

/// Where the parabola at `q` gets below the one at `p`, for p < q.
double intersection(int p, double height_p, int q, double height_q) {
  const double rise = height_q + static_cast<double>(q) * q - height_p - static_cast<double>(p) * p;
  // Between neighbours, as most are, the same without a division.
  return q - p == 1 ? 0.5 * rise : rise / (2.0 * (q - p));
}

}  // namespace

void DistanceUpdate::begin(const GridGeometry& geometry, const GridWindow& window) {
  const auto width = static_cast<std::size_t>(window.width);
  const auto height = static_cast<std::size_t>(window.height);
  const std::size_t count = width * height;
  result_.geometry_ = geometry;
  result_.window_ = window;
  result_.state_.resize(count);
  result_.squared_cells_.assign(count, kNoDistance);
  result_.to_basis_.assign(count, CellOffset{});
  changes_.resize(height);
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
  std::swap(to_nearest_, to_nearest_was_);
  find_nearest_in_columns();
  for (std::size_t y = 0; y < changes_.size(); ++y) {
    update_row(y, moved);
  }
}

/// Row by row, as memory lies. Of two cells equally near the lower counts.
void DistanceUpdate::find_nearest_in_columns() {
  const std::size_t width = above_.size();
  const std::size_t height = changes_.size();
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
  RowChange change{static_cast<int>(width), 0};
  const auto is_as_it_was = [&](std::size_t first, std::size_t last) {
    return std::equal(to_nearest_.data() + row + first, to_nearest_.data() + row + last,
                      to_nearest_was_.data() + row + first);
  };
  // A run that the border cuts may have gone on beyond it before.
  if (moved.x != 0 || !is_as_it_was(0, width)) {
    const std::uint8_t* const is_free = is_free_.data() + row;
    std::size_t behind = 0;
    for_each_run(is_free, 0, width, [&](std::size_t first, std::size_t last) {
      clear_cells(row, behind, first, &change);
      behind = last;
      const bool is_cut = moved.x != 0 && (first == 0 || last == width);
      const std::size_t begin = first > 0 ? first - 1 : first;
      if (is_cut || !is_as_it_was(begin, std::min(last + 1, width))) {
        update_run(row, first, last, &change);
      }
    });
    clear_cells(row, behind, width, &change);
  }
  changes_[y] = change.first < change.last ? change : RowChange{};
}

void DistanceUpdate::put(
    std::size_t row, std::size_t x, std::int32_t squared, CellOffset to, RowChange* change) {
  if (result_.squared_cells_[row + x] == squared && result_.to_basis_[row + x] == to) {
    return;
  }
  result_.squared_cells_[row + x] = squared;
  result_.to_basis_[row + x] = to;
  change->first = std::min(change->first, static_cast<int>(x));
  change->last = std::max(change->last, static_cast<int>(x) + 1);
}

/// Cells that are not free are their own basis points.
void DistanceUpdate::clear_cells(std::size_t row,
                                 std::size_t first,
                                 std::size_t last,
                                 RowChange* change) {
  for (std::size_t x = first; x < last; ++x) {
    put(row, x, 0, {}, change);
  }
}

/// The free cells of a run, by the walls above and below them and those at its ends.
void DistanceUpdate::update_run(std::size_t row,
                                std::size_t first,
                                std::size_t last,
                                RowChange* change) {
  const std::int32_t* const to_nearest = to_nearest_.data() + row;
  std::size_t count = 0;
  const std::size_t end = std::min(last + 1, above_.size());
  for (std::size_t x = first > 0 ? first - 1 : first; x < end; ++x) {
    if (to_nearest[x] == kNone) {
      continue;
    }
    const auto q = static_cast<int>(x);
    const double height = static_cast<double>(to_nearest[x]) * to_nearest[x];
    double start = -std::numeric_limits<double>::infinity();
    while (count > 0) {
      const Parabola& before = envelope_[count - 1];
      start = intersection(before.position, before.height, q, height);
      if (start > before.start) {
        break;
      }
      --count;
      start = -std::numeric_limits<double>::infinity();
    }
    envelope_[count++] = {q, height, start};
  }
  std::size_t k = 0;
  for (std::size_t x = first; x < last; ++x) {
    if (count == 0) {
      put(row, x, DistanceTransform::kUnbounded, {}, change);
      continue;
    }
    while (k + 1 < count && envelope_[k + 1].start < static_cast<double>(x)) {
      ++k;
    }
    const std::int32_t dx = envelope_[k].position - static_cast<int>(x);
    const std::int32_t dy = to_nearest[envelope_[k].position];
    put(row, x, static_cast<std::int32_t>(std::int64_t{dx} * dx + std::int64_t{dy} * dy), {dx, dy},
        change);
  }
}

}  // namespace cairn
