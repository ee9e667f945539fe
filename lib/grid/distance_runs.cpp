#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "grid/distance_update.hpp"

namespace cairn {
namespace {

/// Where the parabola at `q` gets below the one at `p`, for p < q.
double intersection(int p, double height_p, int q, double height_q) {
  const double rise = height_q + static_cast<double>(q) * q - height_p - static_cast<double>(p) * p;
  // Between neighbours, as most are, the same without a division.
  return q - p == 1 ? 0.5 * rise : rise / (2.0 * (q - p));
}

}  // namespace

/// The free cells of a run, by the walls above and below them and those at its ends: where few of
/// these are new, by what was known of the others.
void DistanceUpdate::update_run(const Run& run) {
  if (is_first_) {
    renew_run(run);
    return;
  }
  const std::int32_t* const to_nearest = to_nearest_.data() + run.row;
  const std::int32_t* const was = to_nearest_was_.data() + run.row;
  new_columns_.clear();
  for (std::size_t x = run.begin; x < run.end; ++x) {
    if (to_nearest[x] != was[x]) {
      new_columns_.push_back(static_cast<int>(x));
    }
  }
  constexpr std::size_t kFewOf = 4;
  if (new_columns_.size() * kFewOf > run.end - run.begin) {
    renew_run(run);
    return;
  }
  const std::int32_t farthest = renew_lost(run);
  for (const int column : new_columns_) {
    spread(run, column, farthest);
  }
}

/// Computes the cells of a run anew whose basis point may be gone.
/// @return the largest squared distance in the run
std::int32_t DistanceUpdate::renew_lost(const Run& run) {
  const std::int32_t* const to_nearest = to_nearest_.data() + run.row;
  const std::int32_t* const was = to_nearest_was_.data() + run.row;
  const auto [begin, end] = std::pair(static_cast<int>(run.begin), static_cast<int>(run.end));
  std::int32_t farthest = 0;
  for (std::size_t x = run.first; x < run.last; ++x) {
    const int column = static_cast<int>(x) + result_.to_basis_[run.row + x].dx;
    if (column < begin || column >= end || to_nearest[column] != was[column]) {
      renew_cell(run, x);
    }
    farthest = std::max(farthest, result_.squared_cells_[run.row + x]);
  }
  return farthest;
}

/// Looks at the columns to the left and to the right until they are too far away.
void DistanceUpdate::renew_cell(const Run& run, std::size_t x) {
  const std::int32_t* const to_nearest = to_nearest_.data() + run.row;
  const auto [begin, end] = std::pair(static_cast<int>(run.begin), static_cast<int>(run.end));
  const int at = static_cast<int>(x);
  std::int64_t squared = DistanceTransform::kUnbounded;
  CellOffset to;
  const auto try_column = [&](int column) {
    if (column < begin || column >= end || to_nearest[column] == kNone) {
      return;
    }
    const std::int32_t dx = column - at;
    const std::int32_t dy = to_nearest[column];
    const std::int64_t here = std::int64_t{dx} * dx + std::int64_t{dy} * dy;
    if (here < squared || (here == squared && dx < to.dx)) {
      squared = here;
      to = {dx, dy};
    }
  };
  const int most = std::max(at - begin, end - 1 - at);
  for (int k = 0; k <= most && std::int64_t{k} * k <= squared; ++k) {
    try_column(at - k);
    try_column(at + k);
  }
  put(run.row, x, static_cast<std::int32_t>(squared), to);
}

/// Makes a new column of a run the nearest one wherever it is.
/// @param farthest no cell of the run is farther from its basis point, squared
void DistanceUpdate::spread(const Run& run, int column, std::int32_t farthest) {
  const std::int32_t dy = to_nearest_[run.row + static_cast<std::size_t>(column)];
  const std::int64_t height = std::int64_t{dy} * dy;
  if (dy == kNone || height > farthest) {
    return;
  }
  const auto reach = static_cast<int>(std::sqrt(static_cast<double>(farthest - height))) + 1;
  const auto first =
      static_cast<std::size_t>(std::max(static_cast<int>(run.first), column - reach));
  const auto last = static_cast<std::size_t>(std::clamp<std::int64_t>(
      std::int64_t{column} + reach + 1, 0, static_cast<std::int64_t>(run.last)));
  for (std::size_t x = first; x < last; ++x) {
    const std::int32_t dx = column - static_cast<int>(x);
    const std::int64_t squared = std::int64_t{dx} * dx + height;
    const std::int32_t before = result_.squared_cells_[run.row + x];
    if (squared < before || (squared == before && dx < result_.to_basis_[run.row + x].dx)) {
      put(run.row, x, static_cast<std::int32_t>(squared), {dx, dy});
    }
  }
}

/// All of a run, by the lower envelope of the parabolas over its columns.
void DistanceUpdate::renew_run(const Run& run) {
  const std::int32_t* const to_nearest = to_nearest_.data() + run.row;
  std::size_t count = 0;
  for (std::size_t x = run.begin; x < run.end; ++x) {
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
  for (std::size_t x = run.first; x < run.last; ++x) {
    if (count == 0) {
      put(run.row, x, DistanceTransform::kUnbounded, {});
      continue;
    }
    while (k + 1 < count && envelope_[k + 1].start < static_cast<double>(x)) {
      ++k;
    }
    const std::int32_t dx = envelope_[k].position - static_cast<int>(x);
    const std::int32_t dy = to_nearest[envelope_[k].position];
    put(run.row, x, static_cast<std::int32_t>(std::int64_t{dx} * dx + std::int64_t{dy} * dy),
        {dx, dy});
  }
}

}  // namespace cairn
