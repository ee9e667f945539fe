#include "region/region_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/check.hpp"
#include "region/doorways.hpp"
#include "region/furniture.hpp"
#include "region/region_contacts.hpp"

namespace cairn {
namespace {

/// The basis point of a critical point, and the nearest cell that is not free opposite to it,
/// within 45 degrees; the same one twice where there is none as near as at a critical point.
std::array<Cell, 2> basis_points_of(const DistanceTransform& distances, Cell critical_point) {
  constexpr double kOpposite = -0.7;
  const Cell first = distances.basis_point(critical_point);
  const Vector2d to_first(first.x - critical_point.x, first.y - critical_point.y);
  // Flooding is exact by some cells only.
  const int reach = static_cast<int>(std::ceil(1.5 * to_first.norm())) + 3;
  Cell second = first;
  double least = std::numeric_limits<double>::infinity();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell cell{critical_point.x + dx, critical_point.y + dy};
      const Vector2d to(dx, dy);
      if (distances.window().contains(cell) && distances.state(cell) != CellState::kFree &&
          to.dot(to_first) < kOpposite * to.norm() * to_first.norm() && to.norm() < least) {
        least = to.norm();
        second = cell;
      }
    }
  }
  return {first, second};
}

/// Contacts of two basins, in connected groups: each of them is a line.
class LineFinder {
 public:
  LineFinder(const DistanceTransform& distances, std::vector<BasinContact> contacts)
      : distances_(distances), contacts_(std::move(contacts)), is_taken_(contacts_.size(), 0) {}

  std::vector<CriticalLine> find() {
    std::vector<CriticalLine> lines;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (is_taken_[i] == 0) {
        lines.push_back(line_from(i));
      }
    }
    return lines;
  }

 private:
  CriticalLine line_from(std::size_t start) {
    std::vector<std::size_t> open{start};
    is_taken_[start] = 1;
    std::size_t best = start;
    for (std::size_t next = 0; next < open.size(); ++next) {
      const BasinContact at = contacts_[open[next]];
      const auto rank = [this](std::size_t i) {
        const Cell cell = contacts_[i].cell;
        return std::tuple(-contacts_[i].squared_cells, distances_.squared_clearance_cells(cell),
                          cell);
      };
      best = rank(open[next]) < rank(best) ? open[next] : best;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          take(at, {at.cell.x + dx, at.cell.y + dy}, &open);
        }
      }
    }
    CriticalLine line;
    line.from = static_cast<std::size_t>(contacts_[start].from);
    line.to = static_cast<std::size_t>(contacts_[start].to);
    line.critical_point = contacts_[best].cell;
    line.basis_points = basis_points_of(distances_, line.critical_point);
    const auto& [a, b] = line.basis_points;
    line.width_m =
        distances_.geometry().cell_m * std::max(std::hypot(b.x - a.x, b.y - a.y) - 1.0, 0.0);
    return line;
  }

  void take(const BasinContact& at, Cell cell, std::vector<std::size_t>* open) {
    const auto key = std::tuple(at.from, at.to, cell);
    const auto found = std::lower_bound(contacts_.begin(), contacts_.end(), key,
                                        [](const BasinContact& c, const auto& wanted) {
                                          return std::tuple(c.from, c.to, c.cell) < wanted;
                                        });
    if (found == contacts_.end() || std::tuple(found->from, found->to, found->cell) != key) {
      return;
    }
    const auto index = static_cast<std::size_t>(found - contacts_.begin());
    if (is_taken_[index] == 0) {
      is_taken_[index] = 1;
      open->push_back(index);
    }
  }

  const DistanceTransform& distances_;
  std::vector<BasinContact> contacts_;
  std::vector<std::uint8_t> is_taken_;
};

std::vector<Region> regions_of(const ClearanceBasins& basins, const DistanceTransform& distances) {
  std::vector<Region> regions(static_cast<std::size_t>(basins.count));
  std::vector<std::int32_t> best(regions.size(), -1);
  const double cell_m = distances.geometry().cell_m;
  std::size_t index = 0;
  for (int y = 0; y < basins.height; ++y) {
    for (int x = 0; x < basins.width; ++x, ++index) {
      if (basins.basin_of[index] == ClearanceBasins::kNone) {
        continue;
      }
      const auto number = static_cast<std::size_t>(basins.basin_of[index]);
      regions[number].area_m2 += cell_m * cell_m;
      const std::int32_t squared = distances.squared_clearance_cells({x, y});
      if (squared > best[number]) {
        best[number] = squared;
        regions[number].centre = {x, y};
        regions[number].clearance_m = distances.clearance_m({x, y});
      }
    }
  }
  return regions;
}

/// The grid with all doors shut.
OccupancyGrid shut(OccupancyGrid grid, const std::vector<Doorway>& doors) {
  for (const Doorway& door : doors) {
    for (const Cell cell : cells_of(door)) {
      grid.log_odds(cell) = OccupancyGrid::kOccupiedAbove + 1;
    }
  }
  return grid;
}

/// Gives the cells of shut doors to a basin beside them.
void fill_doors(const DistanceTransform& open,
                const std::vector<Doorway>& doors,
                ClearanceBasins* basins) {
  const auto index_of = [&](Cell c) {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(basins->width) +
           static_cast<std::size_t>(c.x);
  };
  std::vector<Cell> empty;
  for (const Doorway& door : doors) {
    for (const Cell cell : cells_of(door)) {
      if (open.state(cell) == CellState::kFree) {
        empty.push_back(cell);
      }
    }
  }
  bool is_changed = true;
  while (is_changed) {
    is_changed = false;
    for (const Cell cell : empty) {
      for (const Cell next : {Cell{cell.x - 1, cell.y}, Cell{cell.x + 1, cell.y},
                              Cell{cell.x, cell.y - 1}, Cell{cell.x, cell.y + 1}}) {
        std::int32_t& basin = basins->basin_of[index_of(cell)];
        if (basin == ClearanceBasins::kNone && open.window().contains(next) &&
            basins->basin_of[index_of(next)] != ClearanceBasins::kNone) {
          basin = basins->basin_of[index_of(next)];
          is_changed = true;
        }
      }
    }
  }
}

}  // namespace

RegionGraph region_graph(const OccupancyGrid& grid, const RegionOptions& options) {
  CAIRN_CHECK(validate(options).ok());
  OccupancyGrid bare = without_furniture(grid, options.furniture_size_m);
  const DistanceTransform distances = distance_transform(bare);
  const std::vector<Doorway> doors = doorways(distances, options);
  ClearanceBasins basins =
      clearance_basins(distance_transform(shut(std::move(bare), doors)), options);
  fill_doors(distances, doors, &basins);
  join_small_basins(distances, options.min_area_m2, &basins);

  RegionGraph graph;
  graph.geometry = grid.geometry();
  graph.regions = regions_of(basins, distances);
  graph.lines = LineFinder(distances, contacts_of(basins, distances)).find();
  for (std::size_t i = 0; i < graph.lines.size(); ++i) {
    graph.regions[graph.lines[i].from].lines.push_back(i);
    graph.regions[graph.lines[i].to].lines.push_back(i);
  }
  graph.region_of = std::move(basins.basin_of);
  return graph;
}

}  // namespace cairn
