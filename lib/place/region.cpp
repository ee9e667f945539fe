#include "place/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "grid/cell_runs.hpp"

namespace cairn {
namespace {

/// The least squared clearance, in cells, that is at least so many metres.
std::int32_t squared_cells_of(double clearance_m, double cell_m) {
  const double cells = clearance_m / cell_m;
  // What rounding leaves open is decided as a comparison in metres would.
  double squared = std::clamp(std::floor(cells * cells) - 2.0, 0.0, 1e9);
  while (squared < 1e9 && cell_m * std::sqrt(squared) < clearance_m) {
    squared += 1.0;
  }
  return static_cast<std::int32_t>(squared);
}

constexpr std::uint8_t kBarrier = 1;
constexpr std::uint8_t kBounds = 2;   ///< Basis point of a cell of the region.
constexpr std::uint8_t kUnknown = 4;  ///< Such a one that is no wall.

}  // namespace

RegionFinder::RegionFinder(const LocalView& view, double robot_width_m)
    : view_(view), robot_width_m_(robot_width_m) {
  const double cell_m = view.grid.geometry().cell_m;
  const std::int32_t passable_from = squared_cells_of(0.5 * robot_width_m, cell_m);
  const std::int32_t coast_below = squared_cells_of(0.5 * robot_width_m + 1.5 * cell_m, cell_m);
  const std::vector<std::int32_t>& squared = view.distances.squared_clearances_cells();
  is_passable_.resize(squared.size());
  is_coast_.resize(squared.size());
  std::transform(squared.begin(), squared.end(), is_passable_.begin(),
                 [=](std::int32_t s) -> std::uint8_t { return s >= passable_from ? 1 : 0; });
  std::transform(squared.begin(), squared.end(), is_coast_.begin(),
                 [=](std::int32_t s) -> std::uint8_t { return s < coast_below ? 1 : 0; });
}

PlaceRegion RegionFinder::find(const std::vector<Cell>& starts,
                               const std::vector<Gateway>& gateways,
                               const Vector2d& center) {
  is_left_ = is_passable_;
  marks_.assign(is_passable_.size(), 0);
  for (const Gateway& gateway : gateways) {
    bar(gateway);
  }
  flood(starts);
  PlaceRegion region;
  region.radius_m = note_bounds(center);
  region.is_complete = !is_cut() && longest_unknown_m() < robot_width_m_;
  region.contains_robot = holds(view_.robot);
  return region;
}

/// Draws a gateway as an 8-connected line, which a 4-connected flood cannot cross.
void RegionFinder::bar(const Gateway& gateway) {
  const GridGeometry& geometry = view_.grid.geometry();
  const Cell a = geometry.cell_at(gateway.basis_points[0]);
  const Cell b = geometry.cell_at(gateway.basis_points[1]);
  const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
  for (int i = 0; i <= steps; ++i) {
    const Cell c{a.x + static_cast<int>(std::lround((b.x - a.x) * double(i) / steps)),
                 a.y + static_cast<int>(std::lround((b.y - a.y) * double(i) / steps))};
    if (geometry.contains(c)) {
      is_left_[geometry.index_of(c)] = 0;
      marks_[geometry.index_of(c)] |= kBarrier;
    }
  }
}

void RegionFinder::flood(const std::vector<Cell>& starts) {
  const GridGeometry& geometry = view_.grid.geometry();
  runs_.clear();
  open_.clear();
  for (const Cell c : starts) {
    if (geometry.contains(c)) {
      open_.push_back(geometry.index_of(c));
    }
  }
  while (!open_.empty()) {
    const std::size_t seed = open_.back();
    open_.pop_back();
    if (is_left_[seed] != 0) {
      take_run(seed);
    }
  }
}

/// Takes the whole run that a cell lies in; of the rows above and below one cell of every run
/// beside it is left to be looked at.
void RegionFinder::take_run(std::size_t seed) {
  const auto width = static_cast<std::size_t>(view_.grid.geometry().width);
  const std::size_t row = seed - seed % width;
  const std::size_t end = end_of_run(is_left_.data(), seed, row + width, 1);
  std::size_t begin = seed;
  while (begin > row && is_left_[begin - 1] != 0) {
    --begin;
  }
  std::fill(is_left_.begin() + static_cast<std::ptrdiff_t>(begin),
            is_left_.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
  runs_.push_back(
      {static_cast<int>(row / width), static_cast<int>(begin - row), static_cast<int>(end - row)});
  const auto note = [this](std::size_t first, std::size_t) { open_.push_back(first); };
  if (row >= width) {
    for_each_run(is_left_.data(), begin - width, end - width, note);
  }
  if (row + width < is_left_.size()) {
    for_each_run(is_left_.data(), begin + width, end + width, note);
  }
}

/// Notes the basis points of the coast.
/// @return how far from the centre they lie at most
double RegionFinder::note_bounds(const Vector2d& center) {
  const GridGeometry& geometry = view_.grid.geometry();
  const std::vector<CellOffset>& to_basis = view_.distances.basis_offsets();
  unknown_.clear();
  double radius_squared = 0.0;
  for (const CellRun& run : runs_) {
    const std::size_t row = geometry.index_of({0, run.y});
    const auto note = [&](std::size_t at) {
      const Cell basis{static_cast<int>(at - row) + to_basis[at].dx, run.y + to_basis[at].dy};
      std::uint8_t& mark = marks_[geometry.index_of(basis)];
      if ((mark & kBounds) != 0) {
        return;
      }
      mark |= kBounds;
      if (!view_.is_wall_at(basis)) {
        unknown_.push_back(basis);
        mark |= kUnknown;
      }
      radius_squared = std::max(radius_squared, (geometry.center_of(basis) - center).squaredNorm());
    };
    for_each_run(is_coast_.data(), row + static_cast<std::size_t>(run.first),
                 row + static_cast<std::size_t>(run.last),
                 [&](std::size_t first, std::size_t last) {
                   for (std::size_t at = first; at < last; ++at) {
                     note(at);
                   }
                 });
  }
  return std::sqrt(radius_squared);
}

/// Whether the window ends within the region.
bool RegionFinder::is_cut() const {
  const GridGeometry& geometry = view_.grid.geometry();
  return std::any_of(runs_.begin(), runs_.end(), [&](const CellRun& run) {
    return run.y == 0 || run.y == geometry.height - 1 || run.first == 0 ||
           run.last == geometry.width;
  });
}

/// Whether a cell, or one within the robot's half width of it, is flooded.
bool RegionFinder::holds(Cell c) const {
  const auto is_flooded_within = [&](int reach) {
    return std::any_of(runs_.begin(), runs_.end(), [&](const CellRun& run) {
      return std::abs(run.y - c.y) <= reach && run.first <= c.x + reach && run.last > c.x - reach;
    });
  };
  if (is_flooded_within(0)) {
    return true;
  }
  const int reach =
      static_cast<int>(std::ceil(0.5 * robot_width_m_ / view_.grid.geometry().cell_m));
  return !has_mark(c, kBarrier) && view_.distances.clearance_m(c) < 0.5 * robot_width_m_ &&
         is_flooded_within(reach);
}

bool RegionFinder::has_mark(Cell c, std::uint8_t mark) const {
  const GridGeometry& geometry = view_.grid.geometry();
  return geometry.contains(c) && (marks_[geometry.index_of(c)] & mark) != 0;
}

/// Extent of the largest 8-connected piece of the cells of unknown state. To be asked once.
double RegionFinder::longest_unknown_m() {
  const GridGeometry& geometry = view_.grid.geometry();
  double longest = 0.0;
  std::vector<Cell> piece;
  const auto take = [&](Cell c) {
    if (has_mark(c, kUnknown)) {
      marks_[geometry.index_of(c)] &= static_cast<std::uint8_t>(~kUnknown);
      piece.push_back(c);
    }
  };
  for (const Cell first : unknown_) {
    piece.clear();
    take(first);
    if (piece.empty()) {
      continue;
    }
    Cell low = first;
    Cell high = first;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Cell c = piece[i];
      low = {std::min(low.x, c.x), std::min(low.y, c.y)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y)};
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          take({c.x + dx, c.y + dy});
        }
      }
    }
    longest = std::max(longest, std::hypot(high.x - low.x + 1.0, high.y - low.y + 1.0));
  }
  return longest * geometry.cell_m;
}

}  // namespace cairn
