#include "lpm/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

DistanceField::DistanceField(const GridGeometry& geometry)
    : geometry_(geometry), nearest_(geometry.width, geometry.height, kNone) {
  for (std::size_t squared = 0; squared < distance_m_.size(); ++squared) {
    const double cells = std::min(std::sqrt(static_cast<double>(squared)), 1.0 * kReachCells);
    distance_m_[squared] = cells * geometry.cell_m;
  }
  squared_of_.fill(kFar);
  std::array<std::int16_t, kFar> rank{};
  std::int16_t ranks = 0;
  for (int squared = 0; squared < kFar; ++squared) {
    for (int x = 0; x * x <= squared; ++x) {
      const int y = static_cast<int>(std::lround(std::sqrt(squared - x * x)));
      if (x * x + y * y == squared) {
        squared_of_[static_cast<std::size_t>(ranks)] = static_cast<std::uint8_t>(squared);
        rank[static_cast<std::size_t>(squared)] = ranks++;
        break;
      }
    }
  }
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int x = i % kSide - kReachCells;  // of the cell, as seen from the wall
    const int y = i / kSide - kReachCells;
    const int squared = x * x + y * y;
    offset_x_[at] = static_cast<std::int8_t>(-x);
    offset_y_[at] = static_cast<std::int8_t>(-y);
    stamp_[at] = squared >= kFar
                     ? kNone
                     : static_cast<std::int16_t>(
                           (rank[static_cast<std::size_t>(squared)] << kOffsetBits) | i);
  }
}

void DistanceField::look_up(Cell first,
                            int count,
                            const std::array<std::uint8_t, kFar + 1>& by_squared,
                            std::uint8_t* values) const {
  std::array<std::uint8_t, kRanks> by_rank{};
  for (std::size_t rank = 0; rank < kRanks; ++rank) {
    by_rank[rank] = by_squared[squared_of_[rank]];
  }
  for (int done = 0; done < count;) {
    const int run = nearest_.run_length({first.x + done, first.y}, count - done);
    const std::int16_t* const nearest = &nearest_[{first.x + done, first.y}];
    std::transform(nearest, nearest + run, values + done,
                   [&](std::int16_t cell) { return by_rank[rank_of(cell)]; });
    done += run;
  }
}

DistanceField::Sample DistanceField::sample(const Vector2d& p) const {
  const double u = (p.x() - geometry_.origin_m.x()) / geometry_.cell_m - 0.5;
  const double v = (p.y() - geometry_.origin_m.y()) / geometry_.cell_m - 0.5;
  const Cell c{static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v))};
  if (c.x < 0 || c.y < 0 || c.x + 1 >= geometry_.width || c.y + 1 >= geometry_.height) {
    return {distance_m_[kFar], Vector2d::Zero(), false};
  }
  const std::uint8_t s00 = squared_cells(c);
  const std::uint8_t s10 = squared_cells({c.x + 1, c.y});
  const std::uint8_t s01 = squared_cells({c.x, c.y + 1});
  const std::uint8_t s11 = squared_cells({c.x + 1, c.y + 1});
  const double d00 = distance_m_[s00];
  const double d10 = distance_m_[s10];
  const double d01 = distance_m_[s01];
  const double d11 = distance_m_[s11];
  const double fx = u - c.x;
  const double fy = v - c.y;
  const double bottom = d00 + fx * (d10 - d00);
  const double top = d01 + fx * (d11 - d01);
  Sample sample;
  sample.distance_m = bottom + fy * (top - bottom);
  sample.gradient =
      Vector2d((d10 - d00) * (1.0 - fy) + (d11 - d01) * fy, top - bottom) / geometry_.cell_m;
  sample.is_near = std::max({s00, s10, s01, s11}) < kFar;
  return sample;
}

void DistanceField::add_wall(Cell wall) {
  lower_around(wall, {0, 0}, {geometry_.width - 1, geometry_.height - 1});
}

void DistanceField::lower_around(Cell wall, Cell low, Cell high) {
  const int first_x = std::max(low.x, wall.x - kReachCells);
  const int last_x = std::min(high.x, wall.x + kReachCells);
  const int first_y = std::max(low.y, wall.y - kReachCells);
  const int last_y = std::min(high.y, wall.y + kReachCells);
  for (int y = first_y; y <= last_y; ++y) {
    const std::int16_t* stamp =
        &stamp_[static_cast<std::size_t>((y - wall.y + kReachCells) * kSide + kReachCells)] +
        (first_x - wall.x);
    for (int x = first_x; x <= last_x;) {
      const int run = nearest_.run_length({x, y}, last_x + 1 - x);
      std::int16_t* const cells = &nearest_[{x, y}];
      for (int i = 0; i < run; ++i) {
        cells[i] = std::min(cells[i], stamp[i]);
      }
      x += run;
      stamp += run;
    }
  }
}

void DistanceField::renew(const OccupancyGrid& grid, Cell low, Cell high) {
  const auto grown = [this](Cell a, Cell b, int by, Cell* from, Cell* to) {
    *from = {std::max(a.x - by, 0), std::max(a.y - by, 0)};
    *to = {std::min(b.x + by, geometry_.width - 1), std::min(b.y + by, geometry_.height - 1)};
  };
  Cell from;
  Cell to;
  grown(low, high, kReachCells, &from, &to);
  nearest_.fill(from, {to.x + 1, to.y + 1});
  Cell wall_from;
  Cell wall_to;
  grown(from, to, kReachCells, &wall_from, &wall_to);
  for (int y = wall_from.y; y <= wall_to.y; ++y) {
    const OccupancyGrid::LogOdds* const row = grid.cells().data() + geometry_.index_of({0, y});
    for (int x = wall_from.x; x <= wall_to.x; ++x) {
      if (row[x] > OccupancyGrid::kOccupiedAbove) {
        lower_around({x, y}, from, to);
      }
    }
  }
}

void DistanceField::shift(Cell by) {
  nearest_.shift(by);
  geometry_.origin_m += geometry_.cell_m * Vector2d(by.x, by.y);
}

}  // namespace cairn
