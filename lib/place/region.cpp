#include "place/region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

namespace cairn {
namespace {

class RegionFlood {
 public:
  RegionFlood(const LocalView& view, double robot_width_m)
      : view_(view),
        robot_width_m_(robot_width_m),
        barrier_(view.grid.geometry().cell_count(), 0),
        flooded_(view.grid.geometry().cell_count(), 0) {}

  /// Draws a gateway as an 8-connected line, which a 4-connected flood cannot cross.
  void bar(const Gateway& gateway) {
    const GridGeometry& geometry = view_.grid.geometry();
    const Cell a = geometry.cell_at(gateway.basis_points[0]);
    const Cell b = geometry.cell_at(gateway.basis_points[1]);
    const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
    for (int i = 0; i <= steps; ++i) {
      const Cell c{a.x + static_cast<int>(std::lround((b.x - a.x) * double(i) / steps)),
                   a.y + static_cast<int>(std::lround((b.y - a.y) * double(i) / steps))};
      if (geometry.contains(c)) {
        barrier_[geometry.index_of(c)] = 1;
      }
    }
  }

  void flood(const std::vector<Cell>& starts) {
    for (const Cell c : starts) {
      visit(c);
    }
    constexpr std::array<Cell, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (const Cell d : kSides) {
        visit({cells_[i].x + d.x, cells_[i].y + d.y});
      }
    }
  }

  [[nodiscard]] PlaceRegion region(const Vector2d& center) const {
    PlaceRegion region;
    std::set<Cell> unknown;
    bool is_cut = false;
    for (const Cell c : cells_) {
      is_cut = is_cut || at_border(c);
      const Cell basis = view_.distances.basis_point(c);
      if (basis == c || !at_coast(c)) {
        continue;
      }
      if (!view_.is_wall_at(basis)) {
        unknown.insert(basis);
      }
      const Vector2d from_center = view_.grid.geometry().center_of(basis) - center;
      region.radius_m = std::max(region.radius_m, from_center.norm());
    }
    region.is_complete = !is_cut && longest_stretch_m(unknown) < robot_width_m_;
    region.contains_robot = holds(view_.robot);
    return region;
  }

 private:
  void visit(Cell c) {
    const GridGeometry& geometry = view_.grid.geometry();
    if (!geometry.contains(c) || barrier_[geometry.index_of(c)] != 0 ||
        flooded_[geometry.index_of(c)] != 0 ||
        view_.distances.clearance_m(c) < 0.5 * robot_width_m_) {
      return;
    }
    flooded_[geometry.index_of(c)] = 1;
    cells_.push_back(c);
  }

  [[nodiscard]] bool at_border(Cell c) const {
    const GridGeometry& geometry = view_.grid.geometry();
    return c.x == 0 || c.y == 0 || c.x == geometry.width - 1 || c.y == geometry.height - 1;
  }

  /// Whether the robot, there, would about touch what bounds free space.
  [[nodiscard]] bool at_coast(Cell c) const {
    return view_.distances.clearance_m(c) <
           0.5 * robot_width_m_ + 1.5 * view_.grid.geometry().cell_m;
  }

  /// Whether a cell, or one within the robot's half width of it, is flooded.
  [[nodiscard]] bool holds(Cell c) const {
    const GridGeometry& geometry = view_.grid.geometry();
    const int r = static_cast<int>(std::ceil(0.5 * robot_width_m_ / geometry.cell_m));
    const bool is_on_line = geometry.contains(c) && barrier_[geometry.index_of(c)] != 0;
    const bool is_inside = geometry.contains(c) && flooded_[geometry.index_of(c)] != 0;
    if (is_inside || is_on_line || view_.distances.clearance_m(c) >= 0.5 * robot_width_m_) {
      return is_inside;
    }
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx) {
        const Cell d{c.x + dx, c.y + dy};
        if (geometry.contains(d) && flooded_[geometry.index_of(d)] != 0) {
          return true;
        }
      }
    }
    return false;
  }

  /// Extent of the largest 8-connected piece of a set of cells.
  [[nodiscard]] double longest_stretch_m(std::set<Cell> cells) const {
    double longest = 0.0;
    while (!cells.empty()) {
      std::vector<Cell> piece{*cells.begin()};
      cells.erase(cells.begin());
      Cell low = piece.front();
      Cell high = low;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Cell c = piece[i];
        low = {std::min(low.x, c.x), std::min(low.y, c.y)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y)};
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (cells.erase({c.x + dx, c.y + dy}) > 0) {
              piece.push_back({c.x + dx, c.y + dy});
            }
          }
        }
      }
      longest = std::max(longest, std::hypot(high.x - low.x + 1.0, high.y - low.y + 1.0));
    }
    return longest * view_.grid.geometry().cell_m;
  }

  const LocalView& view_;
  double robot_width_m_;
  std::vector<std::uint8_t> barrier_;
  std::vector<std::uint8_t> flooded_;
  std::vector<Cell> cells_;
};

}  // namespace

PlaceRegion flooded_region(const LocalView& view,
                           const std::vector<Cell>& starts,
                           const std::vector<Gateway>& gateways,
                           const Vector2d& center,
                           double robot_width_m) {
  RegionFlood flood(view, robot_width_m);
  for (const Gateway& gateway : gateways) {
    flood.bar(gateway);
  }
  flood.flood(starts);
  return flood.region(center);
}

}  // namespace cairn
