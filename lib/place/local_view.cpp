#include "place/local_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr OccupancyGrid::LogOdds kFreeOdds = OccupancyGrid::kFreeBelow - 1;
constexpr OccupancyGrid::LogOdds kWallOdds = OccupancyGrid::kOccupiedAbove + 1;

/// A wall cell makes a wall, else a free one makes it free: between beams far from the robot most
/// cells were never hit.
OccupancyGrid::LogOdds merged_odds(const OccupancyGrid& grid, Cell lower, int factor) {
  OccupancyGrid::LogOdds odds = 0;
  for (int dy = 0; dy < factor; ++dy) {
    for (int dx = 0; dx < factor; ++dx) {
      const CellState state = grid.state({lower.x + dx, lower.y + dy});
      if (state == CellState::kOccupied) {
        return kWallOdds;
      }
      odds = state == CellState::kFree ? kFreeOdds : odds;
    }
  }
  return odds;
}

OccupancyGrid coarse_window(const OccupancyGrid& grid,
                            const Vector2d& p_grid_robot,
                            const PlaceOptions& options) {
  const GridGeometry& fine = grid.geometry();
  const int factor = std::max(1, static_cast<int>(std::floor(options.cell_m / fine.cell_m + 1e-6)));
  GridGeometry coarse;
  coarse.cell_m = factor * fine.cell_m;
  coarse.width = static_cast<int>(std::ceil(options.window_m / coarse.cell_m));
  coarse.height = coarse.width;
  const auto aligned = [&](double middle) {
    return coarse.cell_m * (std::floor(middle / coarse.cell_m) - coarse.width / 2);
  };
  coarse.origin_m = {aligned(p_grid_robot.x()), aligned(p_grid_robot.y())};

  const Vector2d offset = (coarse.origin_m - fine.origin_m) / fine.cell_m;
  const Cell first{static_cast<int>(std::lround(offset.x())),
                   static_cast<int>(std::lround(offset.y()))};
  OccupancyGrid window(coarse);
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      window.log_odds({x, y}) =
          merged_odds(grid, {first.x + x * factor, first.y + y * factor}, factor);
    }
  }
  return window;
}

/// Unknown cells between free ones on opposite sides become free.
void fill_stripes(OccupancyGrid* grid) {
  constexpr std::array<Cell, 4> kAcross{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  std::vector<Cell> fill;
  for (int y = 0; y < grid->geometry().height; ++y) {
    for (int x = 0; x < grid->geometry().width; ++x) {
      if (grid->state({x, y}) == CellState::kUnknown &&
          std::any_of(kAcross.begin(), kAcross.end(), [&](Cell d) {
            return grid->state({x + d.x, y + d.y}) == CellState::kFree &&
                   grid->state({x - d.x, y - d.y}) == CellState::kFree;
          })) {
        fill.push_back({x, y});
      }
    }
  }
  for (const Cell c : fill) {
    grid->log_odds(c) = kFreeOdds;
  }
}

/// An 8-connected piece of what is not free, from one of its cells.
std::vector<Cell> piece_at(const OccupancyGrid& grid, Cell first, std::vector<bool>* seen) {
  std::vector<Cell> piece{first};
  (*seen)[grid.geometry().index_of(first)] = true;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell c{piece[i].x + dx, piece[i].y + dy};
        if (grid.contains(c) && grid.state(c) != CellState::kFree &&
            !(*seen)[grid.geometry().index_of(c)]) {
          (*seen)[grid.geometry().index_of(c)] = true;
          piece.push_back(c);
        }
      }
    }
  }
  return piece;
}

void clear_specks(double speck_m, OccupancyGrid* grid) {
  const GridGeometry& geometry = grid->geometry();
  const int max_cells = static_cast<int>(std::floor(speck_m / geometry.cell_m + 1e-6));
  std::vector<bool> seen(geometry.cell_count(), false);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      if (seen[geometry.index_of({x, y})] || grid->state({x, y}) == CellState::kFree) {
        continue;
      }
      const std::vector<Cell> piece = piece_at(*grid, {x, y}, &seen);
      const auto [left, right] =
          std::minmax_element(piece.begin(), piece.end(), [](Cell a, Cell b) { return a.x < b.x; });
      const auto [low, high] =
          std::minmax_element(piece.begin(), piece.end(), [](Cell a, Cell b) { return a.y < b.y; });
      const bool is_inside = left->x > 0 && low->y > 0 && right->x < geometry.width - 1 &&
                             high->y < geometry.height - 1;
      if (is_inside && right->x - left->x < max_cells && high->y - low->y < max_cells) {
        for (const Cell c : piece) {
          grid->log_odds(c) = kFreeOdds;
        }
      }
    }
  }
}

/// Cells that are not free, at walls or within two cells of one.
std::vector<bool> walls_with_chinks(const OccupancyGrid& grid) {
  constexpr int kChink = 2;
  std::vector<bool> is_wall(grid.geometry().cell_count(), false);
  for (int y = 0; y < grid.geometry().height; ++y) {
    for (int x = 0; x < grid.geometry().width; ++x) {
      if (grid.state({x, y}) != CellState::kOccupied) {
        continue;
      }
      for (int dy = -kChink; dy <= kChink; ++dy) {
        for (int dx = -kChink; dx <= kChink; ++dx) {
          const Cell c{x + dx, y + dy};
          if (grid.contains(c) && grid.state(c) != CellState::kFree) {
            is_wall[grid.geometry().index_of(c)] = true;
          }
        }
      }
    }
  }
  return is_wall;
}

}  // namespace

LocalView look_around(const OccupancyGrid& grid,
                      const Vector2d& p_grid_robot,
                      const PlaceOptions& options) {
  LocalView view;
  view.grid = coarse_window(grid, p_grid_robot, options);
  fill_stripes(&view.grid);
  clear_specks(options.speck_m, &view.grid);
  view.is_wall = walls_with_chinks(view.grid);
  view.distances = distance_transform(view.grid);
  const GridGeometry& map = grid.geometry();
  view.p_map_low = map.origin_m;
  view.p_map_high = map.origin_m + map.cell_m * Vector2d(map.width, map.height);
  view.robot = view.grid.geometry().cell_at(p_grid_robot);
  MedialAxisOptions axis_options;
  axis_options.min_clearance_m = 0.5 * options.robot_width_m;
  axis_options.coastal_distance_m = options.coastal_distance_m;
  view.axis = medial_axis(view.distances, view.robot, axis_options);
  return view;
}

}  // namespace cairn
