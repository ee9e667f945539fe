#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn::test {

/// A building drawn as text, top line = largest y: '#' solid, anything else free; one character is
/// `character_m` wide and high. Walls are rough by one cell, differently for each seed.
class DrawnWorld {
 public:
  static constexpr double kCell_m = 0.05;

  DrawnWorld(const std::vector<std::string>& lines, double character_m, unsigned seed)
      : lines_(lines), character_m_(character_m) {
    geometry_.cell_m = kCell_m;
    geometry_.width = static_cast<int>(
        std::lround(static_cast<double>(lines.front().size()) * character_m / kCell_m));
    geometry_.height =
        static_cast<int>(std::lround(static_cast<double>(lines.size()) * character_m / kCell_m));
    solid_.resize(geometry_.cell_count());
    for (int y = 0; y < geometry_.height; ++y) {
      for (int x = 0; x < geometry_.width; ++x) {
        solid_[geometry_.index_of({x, y})] = character_at(geometry_.center_of({x, y})) == '#';
      }
    }
    roughen(seed);
  }

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

  [[nodiscard]] bool is_solid(Cell c) const {
    return !geometry_.contains(c) || solid_[geometry_.index_of(c)];
  }

  /// Center of the first character of this kind, by lines from the top.
  [[nodiscard]] Vector2d position_of(char mark) const {
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const std::size_t column = lines_[line].find(mark);
      if (column != std::string::npos) {
        return {(static_cast<double>(column) + 0.5) * character_m_,
                (static_cast<double>(lines_.size() - line) - 0.5) * character_m_};
      }
    }
    return Vector2d::Zero();
  }

  /// An empty map of the whole building.
  [[nodiscard]] OccupancyGrid empty_map() const { return OccupancyGrid(geometry_); }

  /// What a perfect laser in this pose adds to a map: free cells along each beam, a wall at its
  /// end.
  void look(const Pose2& T_world_laser, double field_rad, OccupancyGrid* map) const {
    constexpr int kBeams = 361;
    constexpr double kRange_m = 20.0;
    for (int i = 0; i < kBeams; ++i) {
      const double bearing =
          T_world_laser.theta() + field_rad * (static_cast<double>(i) / (kBeams - 1) - 0.5);
      cast(T_world_laser.translation(), {std::cos(bearing), std::sin(bearing)}, kRange_m, map);
    }
  }

  /// All that can be known: every free cell, and the walls beside them.
  [[nodiscard]] OccupancyGrid full_map() const {
    OccupancyGrid map(geometry_);
    for (int y = 0; y < geometry_.height; ++y) {
      for (int x = 0; x < geometry_.width; ++x) {
        if (!is_solid({x, y})) {
          map.log_odds({x, y}) = kFree;
        } else if (!is_solid({x + 1, y}) || !is_solid({x - 1, y}) || !is_solid({x, y + 1}) ||
                   !is_solid({x, y - 1})) {
          map.log_odds({x, y}) = kWall;
        }
      }
    }
    return map;
  }

 private:
  static constexpr OccupancyGrid::LogOdds kFree = -300;
  static constexpr OccupancyGrid::LogOdds kWall = 300;

  [[nodiscard]] char character_at(const Vector2d& p) const {
    const auto column = static_cast<std::size_t>(p.x() / character_m_);
    const auto from_below = static_cast<std::size_t>(p.y() / character_m_);
    return lines_.at(lines_.size() - 1 - from_below).at(column);
  }

  void roughen(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<bool> rough = solid_;
    for (int y = 1; y + 1 < geometry_.height; ++y) {
      for (int x = 1; x + 1 < geometry_.width; ++x) {
        const bool beside_wall = is_solid({x + 1, y}) || is_solid({x - 1, y}) ||
                                 is_solid({x, y + 1}) || is_solid({x, y - 1});
        if (!is_solid({x, y}) && beside_wall && random() % 4 == 0) {
          rough[geometry_.index_of({x, y})] = true;
        }
      }
    }
    solid_ = rough;
  }

  void cast(const Vector2d& from,
            const Vector2d& direction,
            double range_m,
            OccupancyGrid* map) const {
    for (double r = 0.0; r < range_m; r += 0.5 * kCell_m) {
      const Cell c = geometry_.cell_at(from + r * direction);
      if (is_solid(c)) {
        if (map->contains(c)) {
          map->log_odds(c) = kWall;
        }
        return;
      }
      map->log_odds(c) = kFree;
    }
  }

  std::vector<std::string> lines_;
  double character_m_;
  GridGeometry geometry_;
  std::vector<bool> solid_;
};

}  // namespace cairn::test
