#include "grid/free_component.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/cell_runs.hpp"

namespace cairn {
namespace {

constexpr double kStartSlack_m = 0.5;

}  // namespace

void FreeComponent::find(const DistanceTransform& distances, Cell start, double min_clearance_m) {
  const GridWindow& window = distances.window();
  width_ = static_cast<std::size_t>(window.width);
  height_ = static_cast<std::size_t>(window.height);
  runs_.clear();
  mark_passable(distances, min_clearance_m);
  const int slack_cells = static_cast<int>(std::ceil(kStartSlack_m / distances.geometry().cell_m));
  const std::size_t first =
      nearest_passable(start.x - window.lower.x, start.y - window.lower.y, slack_cells);
  if (first == passable_.size()) {
    return;
  }
  open_.assign(1, first);
  while (!open_.empty()) {
    const std::size_t seed = open_.back();
    open_.pop_back();
    if (passable_[seed] != 0) {
      take_run(seed);
    }
  }
  std::sort(runs_.begin(), runs_.end());
}

void FreeComponent::mark_passable(const DistanceTransform& distances, double min_clearance_m) {
  const double cells = min_clearance_m / distances.geometry().cell_m;
  const double least_squared = std::ceil(std::max(1.0, cells * cells));
  const std::vector<std::int32_t>& squared = distances.squared_clearances_cells();
  passable_.resize(squared.size());
  if (least_squared > static_cast<double>(DistanceTransform::kUnbounded)) {
    std::fill(passable_.begin(), passable_.end(), std::uint8_t{0});
    return;
  }
  const auto least = static_cast<std::int32_t>(least_squared);
  std::transform(squared.begin(), squared.end(), passable_.begin(),
                 [least](std::int32_t value) -> std::uint8_t { return value >= least ? 1 : 0; });
}

std::size_t FreeComponent::nearest_passable(int x0, int y0, int slack_cells) const {
  std::size_t best = passable_.size();
  int best_squared = std::numeric_limits<int>::max();
  const int end_x = std::min(x0 + slack_cells, static_cast<int>(width_) - 1);
  const int end_y = std::min(y0 + slack_cells, static_cast<int>(height_) - 1);
  for (int y = std::max(y0 - slack_cells, 0); y <= end_y; ++y) {
    for (int x = std::max(x0 - slack_cells, 0); x <= end_x; ++x) {
      const int squared = (x - x0) * (x - x0) + (y - y0) * (y - y0);
      const std::size_t at = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
      if (passable_[at] != 0 && squared < best_squared && squared <= slack_cells * slack_cells) {
        best = at;
        best_squared = squared;
      }
    }
  }
  return best;
}

/// Takes the whole run that a cell lies in; of the rows above and below one cell of every run that
/// touches it is left to be looked at.
void FreeComponent::take_run(std::size_t seed) {
  const std::size_t row = seed - seed % width_;
  const std::size_t end = end_of_run(passable_.data(), seed, row + width_, 1);
  std::size_t begin = seed;
  while (begin > row && passable_[begin - 1] != 0) {
    --begin;
  }
  std::fill(passable_.begin() + static_cast<std::ptrdiff_t>(begin),
            passable_.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
  runs_.push_back(
      {static_cast<int>(row / width_), static_cast<int>(begin - row), static_cast<int>(end - row)});
  const std::size_t from = begin > row ? begin - 1 : begin;
  const std::size_t to = end < row + width_ ? end + 1 : end;
  if (row >= width_) {
    add_runs(from - width_, to - width_);
  }
  if (row + width_ < passable_.size()) {
    add_runs(from + width_, to + width_);
  }
}

void FreeComponent::add_runs(std::size_t from, std::size_t to) {
  for_each_run(passable_.data(), from, to,
               [&](std::size_t first, std::size_t) { open_.push_back(first); });
}

}  // namespace cairn
