#include "lpm/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

DistanceField::DistanceField(const GridGeometry& geometry)
    : geometry_(geometry), squared_(geometry.cell_count(), kFar) {
  for (std::size_t squared = 0; squared < distance_m_.size(); ++squared) {
    const double cells = std::min(std::sqrt(static_cast<double>(squared)), 1.0 * kReachCells);
    distance_m_[squared] = cells * geometry.cell_m;
  }
}

DistanceField::Sample DistanceField::sample(const Vector2d& p) const {
  const double u = (p.x() - geometry_.origin_m.x()) / geometry_.cell_m - 0.5;
  const double v = (p.y() - geometry_.origin_m.y()) / geometry_.cell_m - 0.5;
  const Cell c{static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v))};
  if (c.x < 0 || c.y < 0 || c.x + 1 >= geometry_.width || c.y + 1 >= geometry_.height) {
    return {distance_m_[kFar], Vector2d::Zero(), false};
  }
  const std::uint8_t* const lower = &squared_[geometry_.index_of(c)];
  const std::uint8_t* const upper = lower + geometry_.width;
  const double d00 = distance_m_[lower[0]];
  const double d10 = distance_m_[lower[1]];
  const double d01 = distance_m_[upper[0]];
  const double d11 = distance_m_[upper[1]];
  const double fx = u - c.x;
  const double fy = v - c.y;
  const double bottom = d00 + fx * (d10 - d00);
  const double top = d01 + fx * (d11 - d01);
  Sample sample;
  sample.distance_m = bottom + fy * (top - bottom);
  sample.gradient =
      Vector2d((d10 - d00) * (1.0 - fy) + (d11 - d01) * fy, top - bottom) / geometry_.cell_m;
  sample.is_near = std::max({lower[0], lower[1], upper[0], upper[1]}) < kFar;
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
    std::uint8_t* const row = squared_.data() + geometry_.index_of({0, y});
    const int dy2 = (y - wall.y) * (y - wall.y);
    for (int x = first_x; x <= last_x; ++x) {
      const int squared = std::min((x - wall.x) * (x - wall.x) + dy2, 1 * kFar);
      row[x] = std::min(row[x], static_cast<std::uint8_t>(squared));
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
  for (int y = from.y; y <= to.y; ++y) {
    std::uint8_t* const row = squared_.data() + geometry_.index_of({0, y});
    std::fill(row + from.x, row + to.x + 1, kFar);
  }
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
  shift_cells(&squared_, geometry_.width, geometry_.height, by, kFar);
  geometry_.origin_m += geometry_.cell_m * Vector2d(by.x, by.y);
}

void DistanceField::clear() {
  std::fill(squared_.begin(), squared_.end(), kFar);
}

}  // namespace cairn
