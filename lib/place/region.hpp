#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/free_component.hpp"
#include "place/gateway.hpp"
#include "place/local_view.hpp"

namespace cairn {

/// The passable free space of a neighbourhood: what can be reached without crossing a gateway.
struct PlaceRegion {
  bool is_complete =
      false;  ///< No unknown stretch as wide as the robot, and not cut by the window.
  bool contains_robot = false;
  double radius_m = 0.0;  ///< From the centre to the farthest wall or gateway of the region.
};

/// Finds the regions of the places of one look. Good as long as the view.
class RegionFinder {
 public:
  RegionFinder(const LocalView& view, double robot_width_m);

  /// Floods the passable cells from the given ones.
  /// @param gateways lines not to cross, in the frame of the map, as are all coordinates
  [[nodiscard]] PlaceRegion find(const std::vector<Cell>& starts,
                                 const std::vector<Gateway>& gateways,
                                 const Vector2d& center);

 private:
  void bar(const Gateway& gateway);
  void flood(const std::vector<Cell>& starts);
  void take_run(std::size_t seed);
  [[nodiscard]] double note_bounds(const Vector2d& center);
  [[nodiscard]] bool is_cut() const;
  [[nodiscard]] bool holds(Cell c) const;
  [[nodiscard]] double longest_unknown_m();
  [[nodiscard]] bool has_mark(Cell c, std::uint8_t mark) const;

  const LocalView& view_;
  double robot_width_m_;
  std::vector<std::uint8_t> is_passable_;  ///< By cell, 1: wide enough for the robot.
  std::vector<std::uint8_t>
      is_coast_;                       ///< 1: there the robot about touches what bounds free space.
  std::vector<std::uint8_t> is_left_;  ///< 1: passable, not barred, and not flooded so far.
  std::vector<std::uint8_t> marks_;
  std::vector<CellRun> runs_;  ///< Flooded.
  std::vector<std::size_t> open_;
  std::vector<Cell> unknown_;  ///< Cells of unknown state that bound the region.
};

}  // namespace cairn
