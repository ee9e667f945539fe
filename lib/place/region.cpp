#include "place/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

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

class RegionFlood {
 public:
  RegionFlood(const LocalView& view, double robot_width_m)
      : view_(view),
        robot_width_m_(robot_width_m),
        passable_from_(squared_cells_of(0.5 * robot_width_m, view.grid.geometry().cell_m)),
        coast_below_(squared_cells_of(0.5 * robot_width_m + 1.5 * view.grid.geometry().cell_m,
                                      view.grid.geometry().cell_m)),
        marks_(view.grid.geometry().cell_count(), 0) {}

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
        marks_[geometry.index_of(c)] |= kBarrier;
      }
    }
  }

  void flood(const std::vector<Cell>& starts) {
    const GridGeometry& geometry = view_.grid.geometry();
    for (const Cell c : starts) {
      if (geometry.contains(c)) {
        visit(c, geometry.index_of(c));
      }
    }
    const auto width = static_cast<std::size_t>(geometry.width);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Cell c = cells_[i];
      const std::size_t at = geometry.index_of(c);
      if (c.x + 1 < geometry.width) {
        visit({c.x + 1, c.y}, at + 1);
      }
      if (c.y + 1 < geometry.height) {
        visit({c.x, c.y + 1}, at + width);
      }
      if (c.x > 0) {
        visit({c.x - 1, c.y}, at - 1);
      }
      if (c.y > 0) {
        visit({c.x, c.y - 1}, at - width);
      }
    }
  }

  /// To be asked once.
  [[nodiscard]] PlaceRegion region(const Vector2d& center) {
    const GridGeometry& geometry = view_.grid.geometry();
    PlaceRegion region;
    std::vector<Cell> unknown;
    bool is_cut = false;
    double radius_squared = 0.0;
    for (const Cell c : cells_) {
      is_cut = is_cut || at_border(c);
      const std::size_t at = geometry.index_of(c);
      const CellOffset to = view_.distances.basis_offsets()[at];
      // Where the robot, there, would about touch what bounds free space.
      if (to == CellOffset{} || view_.distances.squared_clearances_cells()[at] >= coast_below_) {
        continue;
      }
      const Cell basis{c.x + to.dx, c.y + to.dy};
      std::uint8_t& mark = marks_[geometry.index_of(basis)];
      if ((mark & kBounds) == 0) {
        mark |= kBounds;
        if (!view_.is_wall_at(basis)) {
          unknown.push_back(basis);
          mark |= kUnknown;
        }
        const Vector2d from_center = geometry.center_of(basis) - center;
        radius_squared = std::max(radius_squared, from_center.squaredNorm());
      }
    }
    region.radius_m = std::sqrt(radius_squared);
    region.is_complete = !is_cut && longest_stretch_m(unknown) < robot_width_m_;
    region.contains_robot = holds(view_.robot);
    return region;
  }

 private:
  static constexpr std::uint8_t kBarrier = 1;
  static constexpr std::uint8_t kFlooded = 2;
  static constexpr std::uint8_t kBounds = 4;   ///< Basis point of a cell of the region.
  static constexpr std::uint8_t kUnknown = 8;  ///< Such a one that is no wall.

  void visit(Cell c, std::size_t at) {
    if ((marks_[at] & (kBarrier | kFlooded)) == 0 &&
        view_.distances.squared_clearances_cells()[at] >= passable_from_) {
      marks_[at] |= kFlooded;
      cells_.push_back(c);
    }
  }

  [[nodiscard]] bool has_mark(Cell c, std::uint8_t mark) const {
    const GridGeometry& geometry = view_.grid.geometry();
    return geometry.contains(c) && (marks_[geometry.index_of(c)] & mark) != 0;
  }

  [[nodiscard]] bool at_border(Cell c) const {
    const GridGeometry& geometry = view_.grid.geometry();
    return c.x == 0 || c.y == 0 || c.x == geometry.width - 1 || c.y == geometry.height - 1;
  }

  /// Whether a cell, or one within the robot's half width of it, is flooded.
  [[nodiscard]] bool holds(Cell c) const {
    const int r = static_cast<int>(std::ceil(0.5 * robot_width_m_ / view_.grid.geometry().cell_m));
    const bool is_inside = has_mark(c, kFlooded);
    if (is_inside || has_mark(c, kBarrier) ||
        view_.distances.clearance_m(c) >= 0.5 * robot_width_m_) {
      return is_inside;
    }
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx) {
        if (has_mark({c.x + dx, c.y + dy}, kFlooded)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Extent of the largest 8-connected piece of the cells of unknown state.
  [[nodiscard]] double longest_stretch_m(const std::vector<Cell>& cells) {
    const GridGeometry& geometry = view_.grid.geometry();
    double longest = 0.0;
    std::vector<Cell> piece;
    const auto take = [&](Cell c) {
      if (has_mark(c, kUnknown)) {
        marks_[geometry.index_of(c)] &= static_cast<std::uint8_t>(~kUnknown);
        piece.push_back(c);
      }
    };
    for (const Cell first : cells) {
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

  const LocalView& view_;
  double robot_width_m_;
  std::int32_t passable_from_;  ///< Squared clearance in cells.
  std::int32_t coast_below_;
  std::vector<std::uint8_t> marks_;
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
